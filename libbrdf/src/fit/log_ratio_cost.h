// SPDX-License-Identifier: Apache-2.0
// The residuals of the fit with their analytic Jacobian.
#pragma once

#include "fit/parameters.h"
#include "fit/prepared_samples.h"

#include <ceres/cost_function.h>

#include <cstddef>

namespace brdf::fit {

/// Rows for samples [begin, end), channels adjacent:
///   root_weight soft_l1(log((value cos_i + offset) / (lobes cos_i + offset))).
/// One parameter block, laid out by `layout`. Keeps references to both arguments.
class LogRatioCost final : public ceres::CostFunction {
 public:
  LogRatioCost(const PreparedSamples& samples, const Layout& layout, std::size_t begin, std::size_t end);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const PreparedSamples& samples_;
  const Layout& layout_;
  std::size_t begin_, end_;
};

}  // namespace brdf::fit

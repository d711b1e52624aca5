// SPDX-License-Identifier: Apache-2.0
// Rate-distortion optimised quantisation: integers q that minimise E(step q) + lambda * bits(q).
#pragma once

#include "encode/error_model.h"
#include "residual/residual_code.h"

#include <cstdint>
#include <vector>

namespace brdf::encode {

/// Real-valued minimum of the error model with a slight preference for small coefficients, which keeps regions that were
/// not measured sane. [channel][coefficient].
std::vector<std::vector<double>> solve_coefficients(const ErrorModel& model);

struct Quantised {
  std::vector<std::vector<std::int32_t>> q;  ///< [channel][coefficient], trailing zeros kept
  std::vector<std::uint32_t> end;            ///< one past the last coefficient that is not 0
  double error = 0;                          ///< E(step q)
};

struct QuantiserSettings {
  double step = 1;
  double lambda_scale = 1;  ///< times the slope that belongs to the step
  int passes = 3;
};

/// Coordinate descent over the coefficients in coding order, with the costs that the entropy coder would have.
Quantised quantise(const ErrorModel& model, const std::vector<std::vector<double>>& start,
                   const std::vector<residual::Frequency>& order, bool reciprocal, const QuantiserSettings& settings);

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
// Pearson's goodness-of-fit test.
#pragma once

#include <span>

namespace brdf::cli {

/// Probability that a chi-squared variable with `degrees` degrees of freedom exceeds `value`.
double chi_squared_tail(double value, double degrees) noexcept;

struct FitTest {
  int bins = 0;
  double p_value = 1;
};

/// Observed against expected counts of neighbouring cells, pooled in their order until at least `wanted` are expected
/// in each bin. Both sums must agree.
FitTest chi_squared_test(std::span<const double> observed, std::span<const double> expected, double wanted);

}  // namespace brdf::cli

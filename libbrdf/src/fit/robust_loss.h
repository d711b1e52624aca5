// SPDX-License-Identifier: Apache-2.0
// Soft-L1 loss of a single row.
#pragma once

#include <cmath>

namespace brdf::fit {

/// Log ratios beyond this grow the loss linearly: a model that misses a region by a factor of 1.6 is wrong there, not
/// noisy, and should not pull the rest along.
inline constexpr double loss_width = 0.5;

/// rho(s) = 2 b^2 (sqrt(1 + s / b^2) - 1) of s = u^2, as a residual: value^2 = rho. The solver's own loss functions act
/// on the norm of a whole residual block, while one block here holds many independent rows.
struct SoftL1 {
  double value = 0, slope = 0;  ///< slope = d value / d u
};

inline SoftL1 soft_l1(double u) noexcept {
  const double root = std::sqrt(1 + u * u / (loss_width * loss_width));
  const double ratio = std::sqrt(2 / (1 + root));  // value / u, without the cancellation at small u
  return {u * ratio, 1 / (root * ratio)};
}

}  // namespace brdf::fit

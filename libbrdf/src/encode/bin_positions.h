// SPDX-License-Identifier: Apache-2.0
// Places within the cells of Bins.
#pragma once

#include "encode/bins.h"
#include "geometry/half_difference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace brdf::encode {

inline constexpr double lowest_cosine = 0.02;  // 88.9 degrees: beyond it measurements are extrapolations

inline double theta_of(double u, double kappa) noexcept {
  return 2 * std::asin(std::min(1.0, residual::unwarp(u, kappa) / std::numbers::sqrt2));
}

/// Calls `visit(cell, wi, wo, share)` at count^3 places of every cell, those above the horizon; `share` is 1 / count^3.
template <class Visit>
void for_sub_positions(const Bins& b, const residual::Basis& basis, int count, Visit&& visit) {
  const double share = 1.0 / (count * count * count);
  std::size_t cell = 0;
  for (int i = 0; i < b.n_h; ++i)
    for (int j = 0; j < b.n_d; ++j)
      for (int k = 0; k < b.n_p; ++k, ++cell) {
        if (std::min(b.cos_i[cell], b.cos_o[cell]) < lowest_cosine) continue;
        for (int sub = 0; sub < count * count * count; ++sub) {
          const auto offset = [count](int s) { return (s + 0.5) / count; };
          Vec3d wi, wo;
          geometry::directions_from_half_difference(theta_of((i + offset(sub / count / count)) / b.n_h, basis.kappa_h),
                                                    theta_of((j + offset(sub / count % count)) / b.n_d, basis.kappa_d),
                                                    (k + offset(sub % count)) / b.n_p * std::numbers::pi, wi, wo);
          if (std::min(wi.z, wo.z) >= lowest_cosine) visit(cell, wi, wo, share);
        }
      }
}

}  // namespace brdf::encode

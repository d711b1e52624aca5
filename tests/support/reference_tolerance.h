// SPDX-License-Identifier: Apache-2.0
// How far a float value may be from the double reference: what rounding of the result, of the grid coordinates and of the
// directions (unit only to float precision) can change, and no more.
#pragma once

#include "eval/reference.h"
#include "geometry/half_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brdf::test {

struct ReferenceValue {
  std::vector<double> f, tolerance;
};

inline ReferenceValue reference_value(const LobeSet& lobes, const residual::ResidualGrid& grid, const Vec3f& wi,
                                      const Vec3f& wo) {
  const auto n = static_cast<std::size_t>(lobes.channels);
  const Vec3d i(wi), o(wo);
  ReferenceValue r{std::vector<double>(n), std::vector<double>(n)};
  eval::eval_reference(lobes, grid, i, o, r.f);
  const double relative = 2e-6, epsilon = grid.epsilon;
  for (std::size_t c = 0; c < n; ++c) r.tolerance[c] = relative * (r.f[c] + epsilon);
  if (grid.empty() || !(wi.z > 0) || !(wo.z > 0)) return r;

  const auto hd = geometry::half_difference<double>(i, o);
  const eval::GridCoordinates u = eval::grid_coordinates(grid, i, o);
  // cos phi_d divides by 2 sin theta_h cos theta_d sin theta_d what is known to some 1e-7, since the directions are unit to
  // float precision only, and u_p is its square root
  const double base = std::max(2 * hd.sin_theta_h * hd.cos_theta_d * hd.sin_theta_d, 1e-9);
  const double e = 1e-6 / base, away = std::max(1 - std::fabs(hd.cos_phi_d), 0.0);
  const double delta[3] = {1e-6, 1e-6, std::min(std::sqrt(away + e) - std::sqrt(std::max(away - e, 0.0)), 1.0) + 1e-6};
  std::vector<double> plain(n);
  eval_lobes(lobes, i, o, plain);
  for (std::size_t c = 0; c < n; ++c) {
    const int channel = static_cast<int>(c);
    const double at = eval::ratio_at(grid, u, channel);
    for (int axis = 0; axis < 3; ++axis) {
      double spread = 0;
      // nodes within reach may differ more than its ends; steps of a quarter cell miss their extremes by little
      const int steps = 1 + static_cast<int>(4 * delta[axis] * std::max({grid.n_h, grid.n_d, grid.n_p}));
      for (int step = -steps; step <= steps; ++step) {
        eval::GridCoordinates v = u;
        (axis == 0 ? v.u_h : axis == 1 ? v.u_d : v.u_p) += step * delta[axis] / steps;
        spread = std::max(spread, std::fabs(eval::ratio_at(grid, v, channel) - at));
      }
      r.tolerance[c] += (plain[c] + epsilon) * 1.2 * spread;
    }
    r.tolerance[c] += relative * (plain[c] + epsilon) * at;
  }
  return r;
}

}  // namespace brdf::test

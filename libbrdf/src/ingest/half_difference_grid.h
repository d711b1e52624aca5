// SPDX-License-Identifier: Apache-2.0
// Where the samples of a half/difference table lie.
#pragma once

#include <brdf/measurement.h>

#include "geometry/half_difference.h"

#include <cstddef>
#include <numbers>

namespace brdf::ingest {

/// Angles of bin positions, radians; `bin` may be fractional.
struct HalfDifferenceGrid {
  explicit HalfDifferenceGrid(const HalfDifferenceTable& t) noexcept
      : n_theta_h(t.n_theta_h),
        n_theta_d(t.n_theta_d),
        n_phi_d(t.n_phi_d),
        circle(t.full_circle ? 2 * std::numbers::pi : std::numbers::pi),
        offset(t.position == SamplePosition::centre ? 0.5 : 0.0) {}

  double theta_h(int i) const noexcept {
    const double s = (i + offset) / n_theta_h;
    return s * s * (std::numbers::pi / 2);
  }
  double theta_d(int j) const noexcept { return (j + offset) / n_theta_d * (std::numbers::pi / 2); }
  double phi_d(int k) const noexcept { return (k + offset) / n_phi_d * circle; }

  std::size_t cells() const noexcept {
    return static_cast<std::size_t>(n_theta_h) * static_cast<std::size_t>(n_theta_d) *
           static_cast<std::size_t>(n_phi_d);
  }

  /// Calls visit(cell, wi, wo) for all cells in the order of storage.
  template <class Visit>
  void for_each_cell(Visit&& visit) const {
    std::size_t cell = 0;
    for (int i = 0; i < n_theta_h; ++i) {
      for (int j = 0; j < n_theta_d; ++j) {
        for (int k = 0; k < n_phi_d; ++k, ++cell) {
          Vec3d wi, wo;
          geometry::directions_from_half_difference(theta_h(i), theta_d(j), phi_d(k), wi, wo);
          visit(cell, wi, wo);
        }
      }
    }
  }

  int n_theta_h, n_theta_d, n_phi_d;
  double circle, offset;
};

/// A cell exactly on the horizon counts as below: its cosine comes out as rounding noise around 0.
inline bool above_horizon(const Vec3d& wi, const Vec3d& wo) noexcept {
  constexpr double noise = 1e-12;
  return wi.z > noise && wo.z > noise;
}

}  // namespace brdf::ingest

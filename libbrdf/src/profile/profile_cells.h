// SPDX-License-Identifier: Apache-2.0
// Pairs of directions within the cells of a profile.
#pragma once

#include "geometry/half_difference.h"

#include <brdf/profile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace brdf::profile {

/// Directions at a place of a cell, given as shares of its widths, each 0 to 1, in the coordinates in which cells are even.
/// Either direction may be below the horizon.
inline void directions_in_cell(std::size_t cell, double h, double d, double p, Vec3d& wi, Vec3d& wo) noexcept {
  constexpr auto n_d = static_cast<std::size_t>(ProfileGrid::theta_d), n_p = static_cast<std::size_t>(ProfileGrid::phi_d);
  const double u_h = (static_cast<double>(cell / n_p / n_d) + h) / ProfileGrid::theta_h;
  const double u_d = (static_cast<double>(cell / n_p % n_d) + d) / ProfileGrid::theta_d;
  const double u_p = (static_cast<double>(cell % n_p) + p) / ProfileGrid::phi_d;
  const auto angle = [](double chord) { return 2 * std::asin(std::min(chord / std::numbers::sqrt2, 1.0)); };
  const double phi = u_p <= 0.5 ? 2 * std::asin(u_p * std::numbers::sqrt2) : std::numbers::pi - 2 * std::asin((1 - u_p) * std::numbers::sqrt2);
  geometry::directions_from_half_difference(angle(u_h * u_h), angle(u_d), phi, wi, wo);
}

/// Calls `visit(wi, wo)` at count^3 evenly spread places of a cell, those with both cosines of at least `lowest`. The sign of
/// phi_d, which a profile does not keep, alternates.
template <class Visit>
void for_places(std::size_t cell, int count, double lowest, Visit&& visit) {
  const auto middle = [count](int i) { return (i + 0.5) / count; };
  for (int i = 0; i < count * count * count; ++i) {
    Vec3d wi, wo;
    directions_in_cell(cell, middle(i / count / count), middle(i / count % count), middle(i % count), wi, wo);
    if (i % 2 != 0) wi.y = -wi.y, wo.y = -wo.y;
    if (std::min(wi.z, wo.z) >= lowest) visit(wi, wo);
  }
}

/// Cosine below which nothing is compared: 88.9 degrees. Beyond it measurements are extrapolations.
inline constexpr double lowest_cosine = 0.02;

}  // namespace brdf::profile

// SPDX-License-Identifier: Apache-2.0
// Half vectors that crowd around the normal, so that narrow lobes are not missed by a fixed set of directions.
#pragma once

#include <brdf/direction.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace brdf::metrics {

/// theta_h = (pi / 2) u^2, phi_h = 2 pi v: the spacing of the bins of a MERL table.
inline Vec3d half_vector(double u, double v) noexcept {
  const double theta = 0.5 * std::numbers::pi * u * u, phi = 2 * std::numbers::pi * v;
  const double s = std::sin(theta);
  return {s * std::cos(phi), s * std::sin(phi), std::cos(theta)};
}

/// Density per solid angle of the direction that `half_vector` reflects `wo` into, at wi (or the other way round):
/// p(h) / (4 wo.h).
inline double reflected_density(const Vec3d& wi, const Vec3d& wo) noexcept {
  const Vec3d h = glm::normalize(wi + wo);
  const double theta = std::max(std::atan2(std::hypot(h.x, h.y), h.z), 1e-9);
  const double p_h = 1 / (2 * std::numbers::pi * std::sqrt(2 * std::numbers::pi * theta) * std::sin(theta));
  return p_h / (4 * std::max(glm::dot(wo, h), 1e-9));
}

inline Vec3d reflect_about(const Vec3d& w, const Vec3d& h) noexcept { return 2 * glm::dot(w, h) * h - w; }

/// Directions travel as floats: reference and candidate must see the same numbers.
inline Vec3f rounded(const Vec3d& w) noexcept { return Vec3f(w); }

}  // namespace brdf::metrics

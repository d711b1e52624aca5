// SPDX-License-Identifier: Apache-2.0
// A map of the unit square to half of the directions above the horizon, by half vectors: S is the height of the half
// vector, v its azimuth from the view.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace brdf::sample {

/// Views lower than this count as this high: quotients stay finite.
inline constexpr float min_view_cosine = 1e-6f;
/// Least cosine of a direction drawn: what rounding would put at the horizon stays above it.
inline constexpr float min_drawn_cosine = 1e-9f;

/// The map of one view (s, 0, c), in double. A half vector h at azimuth phi and polar angle theta_h sends the view to
/// wi = 2 (wo . h) h - wo, which is above the horizon exactly for theta_h < theta_max(phi),
///   cos 2 theta_max = -x / sqrt(c^2 + x^2),   x = s cos phi.
/// S = (1 - cos theta_h) / (1 - cos theta_max). v is a half-angle sine of phi in [0, pi] from its nearer end, so that no
/// trigonometric function is needed: 1 - cos phi = 4 v^2 below v = 1/2, 1 + cos phi = 4 (1 - v)^2 above. The other half of
/// the directions mirrors this one.
struct HalfVectorMap {
  double s, c;

  explicit HalfVectorMap(double cos_o) noexcept
      : s(std::sqrt(std::max(1 - cos_o * cos_o, 0.0))), c(std::max(cos_o, static_cast<double>(min_view_cosine))) {}

  static double cos_phi(double v) noexcept { return v <= 0.5 ? 1 - 4 * v * v : 4 * (1 - v) * (1 - v) - 1; }

  /// d phi / d v
  static double stretch(double v) noexcept {
    const double w = std::min(v, 1 - v);
    return 4 / std::sqrt(2 - 4 * w * w);
  }

  /// 1 - cos theta_max, without cancellation on either side.
  double horizon(double cos_phi) const noexcept {
    const double x = s * cos_phi, r = std::hypot(c, x), sum = r + std::fabs(x);
    const double large = sum / r, small = c * c / (r * sum);  // 1 + |x| / r and 1 - |x| / r
    return x >= 0 ? 0.5 * large / (1 + std::sqrt(0.5 * small)) : 0.5 * small / (1 + std::sqrt(0.5 * large));
  }

  struct Point {
    glm::dvec3 wi;
    double area;  ///< solid angle of wi per area of (S, v)
  };

  Point direction(double height, double v) const noexcept {
    const double cosine = cos_phi(v), sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)), top = horizon(cosine);
    const double y = height * top, rho = std::sqrt(y * (2 - y));
    const glm::dvec3 h{rho * cosine, rho * sine, 1 - y};
    const double d = s * h.x + c * h.z;
    return {{2 * d * h.x - s, 2 * d * h.y, 2 * d * h.z - c}, 4 * d * top * stretch(v)};
  }

  struct Square {
    double height, v;
  };

  /// The point of a direction above the horizon, on either side.
  Square point(const glm::dvec3& wi) const noexcept {
    const double x = wi.x + s, y = wi.y, z = wi.z + c, across2 = y * y, rho2 = x * x + across2, rho = std::sqrt(rho2);
    const double length = std::sqrt(rho2 + z * z), divisor = rho * (rho + std::fabs(x));
    const double w = divisor > 0 ? 0.5 * std::sqrt(across2 / divisor) : 0, v = x >= 0 ? w : 1 - w;
    return {std::min(rho2 / (length * (length + z)) / horizon(cos_phi(v)), 1.0), v};
  }
};

}  // namespace brdf::sample

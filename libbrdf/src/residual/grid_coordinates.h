// SPDX-License-Identifier: Apache-2.0
// The coordinates in which the residual lives: each axis runs over [0, 1] and needs one square root and at most one
// division, no inverse trigonometric function.
#pragma once

#include "geometry/half_difference.h"

#include <algorithm>
#include <cmath>

namespace brdf::residual {

/// t = sqrt(1 - cos theta) = sqrt(2) sin(theta / 2), accurate near 0.
template <class T>
inline T chord(T sin_theta, T cos_theta) noexcept {
  return sin_theta / std::sqrt(T(1) + cos_theta);
}

/// Share of an axis that follows the warp; the rest is linear, so that wide angles keep nodes of their own.
inline constexpr double warp_share = 0.6;

/// Monotone map of [0, 1] onto itself with slope (1 + kappa) / kappa at 0 for its warped share; kappa > 0, large = linear.
template <class T>
inline T warp(T t, T kappa) noexcept {
  return t * (T(warp_share) * (T(1) + kappa) / (t + kappa) + T(1 - warp_share));
}

/// Inverse of warp (double precision is enough for node positions).
inline double unwarp(double u, double kappa) noexcept {
  // u (t + k) = t (s (1 + k) + (1 - s)(t + k))  ->  (1 - s) t^2 + (s (1 + k) + (1 - s) k - u) t - u k = 0
  const double a = 1 - warp_share, b = warp_share * (1 + kappa) + a * kappa - u, c = -u * kappa;
  const double root = std::sqrt(b * b - 4 * a * c);
  return std::clamp(b >= 0 ? -2 * c / (b + root) : (root - b) / (2 * a), 0.0, 1.0);
}

/// phi_d in [0, pi] onto [0, 1] by half-angle sines from both ends: 0 at phi_d = 0, 1/2 at pi/2, 1 at pi.
template <class T>
inline T phi_coordinate(T cos_phi) noexcept {
  return cos_phi >= T(0) ? T(0.5) * std::sqrt(T(1) - cos_phi) : T(1) - T(0.5) * std::sqrt(T(1) + cos_phi);
}

/// Inverse: cos phi_d of a coordinate.
inline double cos_phi_of(double v) noexcept {
  return v <= 0.5 ? 1 - 4 * v * v : 4 * (1 - v) * (1 - v) - 1;
}

}  // namespace brdf::residual

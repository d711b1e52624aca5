// SPDX-License-Identifier: Apache-2.0
// A map of the unit square to half of the directions above the horizon, by half vectors: S is the height of the half
// vector, v its azimuth from the view.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace brdf::sample {

/// Views lower than this count as this high: quotients stay finite.
inline constexpr float min_view_cosine = 1e-6f;
/// Least cosine of a direction drawn: what rounding would put at the horizon stays above it.
inline constexpr float min_drawn_cosine = 1e-9f;
/// The largest float below 1.
inline constexpr float below_one = 1.0f - 0.5f * std::numeric_limits<float>::epsilon();

/// The map of one view (s, 0, c). A half vector h at azimuth phi from the view and polar angle theta_h sends the view to
/// wi = 2 (wo . h) h - wo, which is above the horizon exactly for theta_h < theta_max(phi),
///   cos 2 theta_max = -x / sqrt(c^2 + x^2),   x = s cos phi.
/// S = (1 - cos theta_h) / (1 - cos theta_max). v is a half-angle sine of phi in [0, pi] from its nearer end, so that no
/// trigonometric function is needed: 1 - cos phi = 4 v^2 below v = 1/2, 1 + cos phi = 4 (1 - v)^2 above. The other half of
/// the directions mirrors this one.
template <class T>
struct HalfVectorMap {
  T s, c;

  HalfVectorMap(T sin_o, T cos_o) noexcept : s(sin_o), c(std::max(cos_o, static_cast<T>(min_view_cosine))) {}

  /// v as the distance from its nearer end.
  struct Azimuth {
    T w;
    bool near;
  };
  static Azimuth azimuth(T v) noexcept { return v <= T(0.5) ? Azimuth{v, true} : Azimuth{1 - v, false}; }
  static T cos_phi(Azimuth a) noexcept { return a.near ? 1 - 4 * a.w * a.w : 4 * a.w * a.w - 1; }

  /// 1 - cos theta_max, without cancellation on either side.
  T horizon(T cos_phi) const noexcept {
    const T x = s * cos_phi, r = std::sqrt(c * c + x * x), sum = r + std::fabs(x), inverse = T(0.5) / (r * sum);
    const T large = sum * sum * inverse, small = c * c * inverse;  // (1 + |x| / r) / 2 and (1 - |x| / r) / 2
    return x >= 0 ? large / (1 + std::sqrt(small)) : small / (1 + std::sqrt(large));
  }

  /// Solid angle per area of (S, v) on one side: d omega_i = 4 (wo . h) d omega_h, d phi / d v = 4 / sqrt(2 - 4 w^2).
  static T area(Azimuth a, T wo_h, T top) noexcept { return 16 * wo_h * top / std::sqrt(2 - 4 * a.w * a.w); }

  struct Half {
    T x, y, z;   ///< half vector: along the view's azimuth, across it, along the normal
    T wo_h;      ///< its cosine with the view
    T area;      ///< solid angle of wi per area of (S, v)
  };

  Half half_vector(T height, T v) const noexcept {
    const Azimuth a = azimuth(v);
    const T cosine = cos_phi(a), sine = a.w * std::sqrt(8 - 16 * a.w * a.w), top = horizon(cosine);
    const T y = height * top, rho = std::sqrt(y * (2 - y));
    Half h{rho * cosine, rho * sine, 1 - y, 0, 0};
    h.wo_h = s * h.x + c * h.z;
    h.area = area(a, h.wo_h, top);
    return h;
  }

  struct Point {
    T height, v, area;
  };

  /// The point of a direction above the horizon, on either side, by the sum wi + wo.
  Point point(T along, T across, T z) const noexcept {
    const T across2 = across * across, rho2 = along * along + across2, rho = std::sqrt(rho2);
    const T length = std::sqrt(rho2 + z * z), divisor = std::max(rho * (rho + std::fabs(along)), T(1e-36));
    const Azimuth a{T(0.5) * std::sqrt(std::min(across2 / divisor, T(1))), along >= 0};
    const T top = horizon(cos_phi(a));
    return {std::min(rho2 / (length * (length + z) * top), T(1)), a.near ? a.w : 1 - a.w, area(a, T(0.5) * length, top)};
  }
};

}  // namespace brdf::sample

// SPDX-License-Identifier: Apache-2.0
// Rusinkiewicz (1998) half/difference coordinates without inverse trigonometric functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace brdf::geometry {

/// Coordinates of an isotropic pair. Every value is symmetric (or, for cos_phi_d, exactly antisymmetric) under exchange
/// of the directions, to the last bit.
template <class T>
struct HalfDifference {
  T sin_theta_h, cos_theta_h;  ///< of the half vector, in [0, 1]
  T sin_theta_d, cos_theta_d;  ///< half the angle between the directions
  T cos_phi_d;                 ///< in [-1, 1]; 0 where phi_d has no meaning; sign flips when wi and wo are exchanged
};

/// From unit vectors above the horizon. cos theta_i = cos theta_h cos theta_d - sin theta_h sin theta_d cos phi_d, and
/// cos theta_o the same with +, so their difference gives cos phi_d and no frame has to be built.
template <class T>
inline HalfDifference<T> half_difference(const glm::vec<3, T>& wi, const glm::vec<3, T>& wo) noexcept {
  const T sx = wi.x + wo.x, sy = wi.y + wo.y, sz = wi.z + wo.z;
  const T dx = wi.x - wo.x, dy = wi.y - wo.y, dz = wi.z - wo.z;
  const T s2 = sx * sx + sy * sy + sz * sz, d2 = dx * dx + dy * dy + dz * dz;
  HalfDifference<T> r;
  const T s = std::sqrt(s2);
  const T inv = s > T(0) ? T(1) / s : T(0);
  const T sxy = std::sqrt(sx * sx + sy * sy);
  r.sin_theta_h = std::min(sxy * inv, T(1));
  r.cos_theta_h = std::min(std::max(sz * inv, T(0)), T(1));
  // normalising by s2 + d2 (4 for exact unit vectors) absorbs rounding of the inputs
  const T norm = T(1) / std::sqrt(s2 + d2);
  r.sin_theta_d = std::min(std::sqrt(d2) * norm, T(1));
  r.cos_theta_d = std::min(s * norm, T(1));
  const T den = sxy * std::sqrt(d2);  // = 4 sin theta_h cos theta_d sin theta_d
  const T num = -dz * s;              // = 2 cos theta_d (cos theta_o - cos theta_i)
  r.cos_phi_d = den > T(0) ? std::min(std::max(num / den, T(-1)), T(1)) : T(0);
  return r;
}

/// Inverse with h in the x-z plane: directions for theta_h, theta_d, phi_d (radians). Either may be below the horizon.
template <class T>
inline void directions_from_half_difference(T theta_h, T theta_d, T phi_d, glm::vec<3, T>& wi, glm::vec<3, T>& wo) noexcept {
  const T ch = std::cos(theta_h), sh = std::sin(theta_h), cd = std::cos(theta_d), sd = std::sin(theta_d);
  const T x = sd * std::cos(phi_d), y = sd * std::sin(phi_d);
  wi = {ch * x + sh * cd, y, ch * cd - sh * x};
  wo = {-ch * x + sh * cd, -y, ch * cd + sh * x};
}

}  // namespace brdf::geometry

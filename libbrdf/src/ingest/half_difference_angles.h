// SPDX-License-Identifier: Apache-2.0
// Rusinkiewicz (1998) half/difference angles, for tables whose bins are angles.
#pragma once

#include <brdf/direction.h>

#include <cmath>

namespace brdf::ingest {

struct HalfDifferenceAngles {
  double theta_h, theta_d;  ///< radians, [0, pi / 2] above the horizon
  double phi_d;             ///< [-pi, pi]
};

/// From unit vectors above the horizon. No angle comes from the arc cosine of a dot product, which cannot resolve
/// angles near zero; the difference direction comes from wi - wo, which has no part along h to cancel. Exchange of the
/// directions keeps theta_h and theta_d and negates both arguments of phi_d, each to the last bit; `fold` then folds
/// phi_d onto [0, pi], so that it stays the same, too.
inline HalfDifferenceAngles half_difference_angles(const Vec3d& wi, const Vec3d& wo, bool fold) noexcept {
  const Vec3d s = wi + wo, d = wi - wo;
  const double rho = std::sqrt(s.x * s.x + s.y * s.y);
  const double length = std::sqrt(rho * rho + s.z * s.z);
  constexpr double pole = 1e-12;  // below this sine the azimuth of h has no meaning and counts as 0
  const bool off_pole = rho > pole * length;
  const double c = off_pole ? s.x / rho : 1, e = off_pole ? s.y / rho : 0;
  // (x, y) = d in the frame whose z axis is h and whose x axis leans away from the normal; both are times |s|
  double x = (c * d.x + e * d.y) * s.z - rho * d.z;
  double y = (c * d.y - e * d.x) * length;
  const double theta_d = std::atan2(std::sqrt(x * x + y * y), length * length);
  if (fold && (y < 0 || (y == 0 && x < 0))) {
    x = -x;
    y = -y;
  }
  return {std::atan2(rho, s.z), theta_d, std::atan2(y, x)};
}

}  // namespace brdf::ingest

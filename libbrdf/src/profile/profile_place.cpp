// SPDX-License-Identifier: Apache-2.0
#include "geometry/half_difference.h"

#include <brdf/profile.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf {
namespace {

/// sqrt(2) sin(theta / 2) from the sine, which keeps its digits near the pole.
float chord(float sine, float cosine) noexcept { return sine / std::sqrt(1.0F + cosine); }

template <class Real>
int bin(Real share, int count) noexcept {
  return std::clamp(static_cast<int>(share * static_cast<Real>(count)), 0, count - 1);
}

double angle_of_chord(double c) noexcept { return 2 * std::asin(std::min(c / std::numbers::sqrt2, 1.0)); }

/// acos to 7e-5 radians, in a few operations (Abramowitz and Stegun 1964, 4.4.45); never above pi/2.
float theta_of(float cosine) noexcept {
  const float x = std::min(cosine, 1.0F);
  return std::sqrt(1 - x) * (1.5707288F + x * (-0.2121144F + x * (0.0742610F - 0.0187293F * x)));
}

/// Sixteenths of the circle, without an arc tangent: the octant by signs and order, its halves by tan(22.5 degrees).
int sixteenth(float x, float y) noexcept {
  static_assert(ProfileGrid::phi_h == 16);
  constexpr float half_octant = 0.41421356F;
  const float ax = std::abs(x), ay = std::abs(y);
  const int within = ay < ax ? (ay < half_octant * ax ? 0 : 1) : (ax > half_octant * ay ? 2 : 3);  // of the quadrant
  if (y >= 0) return x >= 0 ? within : 7 - within;
  return x < 0 ? 8 + within : 15 - within;
}

std::uint8_t theta_bin(float theta) noexcept {
  return static_cast<std::uint8_t>(bin(theta * (2 * std::numbers::inv_pi_v<float>), ProfileGrid::theta));
}

}  // namespace

double ProfileGrid::theta_h_edge(int i) noexcept {
  const double share = static_cast<double>(i) / theta_h;
  return angle_of_chord(share * share);
}

double ProfileGrid::theta_d_edge(int i) noexcept { return angle_of_chord(static_cast<double>(i) / theta_d); }

double ProfileGrid::phi_d_edge(int i) noexcept {
  const double u = static_cast<double>(i) / phi_d;
  return u <= 0.5 ? 2 * std::asin(u * std::numbers::sqrt2) : std::numbers::pi - 2 * std::asin((1 - u) * std::numbers::sqrt2);
}

ProfilePlace profile_place(const Vec3f& wi, const Vec3f& wo) noexcept {
  ProfilePlace p;
  const float sum = wi.x + wi.y + wi.z + wo.x + wo.y + wo.z;
  if (!std::isfinite(sum)) return p;
  if (wi.z * wo.z < 0) {
    p.transmission = true;
    return p;
  }
  if (!(wi.z > 0 && wo.z > 0)) return p;
  const geometry::HalfDifference<float> g = geometry::half_difference(wi, wo);
  const int h = bin(std::sqrt(chord(g.sin_theta_h, g.cos_theta_h)), ProfileGrid::theta_h);
  const int d = bin(chord(g.sin_theta_d, g.cos_theta_d), ProfileGrid::theta_d);
  const float u = g.cos_phi_d >= 0 ? std::sqrt(1 - g.cos_phi_d) / 2 : 1 - std::sqrt(1 + g.cos_phi_d) / 2;
  p.cell = static_cast<std::uint32_t>((h * ProfileGrid::theta_d + d) * ProfileGrid::phi_d + bin(u, ProfileGrid::phi_d));
  p.phi_h = static_cast<std::uint8_t>(sixteenth(wi.x + wo.x, wi.y + wo.y));
  p.theta_i = theta_of(wi.z);
  p.theta_o = theta_of(wo.z);
  p.theta_i_bin = theta_bin(p.theta_i);
  p.theta_o_bin = theta_bin(p.theta_o);
  return p;
}

}  // namespace brdf

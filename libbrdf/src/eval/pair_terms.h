// SPDX-License-Identifier: Apache-2.0
// What evaluation needs to know of a pair of directions, in a form that exchange of the two cannot change by a bit.
#pragma once

#include <brdf/direction.h>

#include <algorithm>
#include <cmath>

namespace brdf::eval {

/// Cosines below this count as this in the lobes: no denominator leaves the range of float, and nothing in reach of a
/// measurement changes. 89.99999 degrees have 1.7e-7.
inline constexpr float min_cosine = 1e-9f;
/// Smallest normal float, rounded up.
inline constexpr float min_denominator = 1.2e-38f;
/// A power of two that denominators of normal distributions carry, and their numerators squared: those are as |s|^4, which
/// at the horizon, with alpha 1e-5, would leave the range of float.
inline constexpr float ndf_scale = 0x1p38f;
/// Longer pairs than two vectors of length 2 are no directions.
inline constexpr float max_norm2 = 16.0f;

/// With s = wi + wo and d = wi - wo. The retro lobe turns wo by pi about the normal, which only exchanges the parts of s
/// and d that lie in the surface: no second half vector is built. The two cosines are sorted and d enters by squares or
/// magnitudes, hence the symmetry, which contraction to fused multiply-add does not disturb.
struct PairTerms {
  float low, high;         ///< the smaller and the larger cosine, at least min_cosine
  float s_xy2, d_xy2;      ///< squared parts in the surface
  float s_z, s_z2, d_z;    ///< d_z = |wi.z - wo.z|
  float cross;             ///< s x d along the normal
  float rise;              ///< wo.z - wi.z: its sign is that of cos phi_d, and the sign of `cross` that of sin phi_d
  float s2, s;             ///< |s|^2 and |s|
  float norm, inv_norm;    ///< |(s, d)|, 2 for unit vectors, and its inverse: cos theta_d = s inv_norm
  bool valid;              ///< above the horizon, and numbers
};

inline PairTerms pair_terms(const Vec3f& wi, const Vec3f& wo) noexcept {
  PairTerms p;
  const float sx = wi.x + wo.x, sy = wi.y + wo.y, dx = wi.x - wo.x, dy = wi.y - wo.y;
  const float cos_i = std::max(wi.z, min_cosine), cos_o = std::max(wo.z, min_cosine);
  p.low = std::min(cos_i, cos_o);
  p.high = std::max(cos_i, cos_o);
  p.rise = wo.z - wi.z;
  p.s_xy2 = sx * sx + sy * sy;
  p.d_xy2 = dx * dx + dy * dy;
  p.s_z = cos_i + cos_o;
  p.s_z2 = p.s_z * p.s_z;
  p.d_z = p.high - p.low;
  p.cross = sx * dy - sy * dx;
  p.s2 = p.s_xy2 + p.s_z2;
  // |s|^2 + |d|^2 = 4 for unit vectors; the tangents at 4 are exact to 1e-6 for vectors within 1e-3 of unit
  const float norm2 = p.s2 + (p.d_xy2 + p.d_z * p.d_z);
  p.s = std::sqrt(p.s2);
  p.norm = 1.0f + 0.25f * norm2;
  p.inv_norm = 0.75f - 0.0625f * norm2;
  p.valid = wi.z > 0.0f && wo.z > 0.0f && norm2 < max_norm2;
  return p;
}

/// (1 - cos theta_d)^5 (Schlick 1994, eq. 24).
inline float schlick_weight(float cos_theta_d) noexcept {
  const float m = std::max(1.0f - cos_theta_d, 0.0f), m2 = m * m;
  return m2 * m2 * m;
}

}  // namespace brdf::eval

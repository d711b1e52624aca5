// SPDX-License-Identifier: Apache-2.0
// Maps of the unit square to the directions of the mixture's components.
#pragma once

#include "eval/lobe_params.h"

#include <brdf/direction.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brdf::eval {

/// sin and cos of pi/2 r for |r| <= 1/2, as polynomials in r^2 through the Chebyshev nodes; error below 3e-9.
struct TurnPolynomials {
  static constexpr float s1 = 1.570796322f, s3 = -0.6459634777f, s5 = 0.07968021765f, s7 = -0.004602149213f;
  static constexpr float c2 = -1.233700549f, c4 = 0.2536694104f, c6 = -0.02086152834f, c8 = 0.0009067398958f;
};

/// (cos, sin) of 2 pi u for u in [0, 1].
inline void turn(float u, float& cosine, float& sine) noexcept {
  const float quarters = 4.0f * u, nearest = std::floor(quarters + 0.5f), r = quarters - nearest, r2 = r * r;
  using P = TurnPolynomials;
  const float s = r * (P::s1 + r2 * (P::s3 + r2 * (P::s5 + r2 * P::s7)));
  const float c = 1.0f + r2 * (P::c2 + r2 * (P::c4 + r2 * (P::c6 + r2 * P::c8)));
  const int quadrant = static_cast<int>(nearest) & 3;
  const float a = quadrant & 1 ? s : c, b = quadrant & 1 ? c : s;
  cosine = quadrant == 1 || quadrant == 2 ? -a : a;
  sine = quadrant & 2 ? -b : b;
}

inline constexpr float largest_below_one = 1.0f - 0.5f * std::numeric_limits<float>::epsilon();

/// Random numbers into [0, 1), NaN to 0.
inline float into_unit_interval(float u) noexcept { return std::min(std::max(0.0f, u), largest_below_one); }

/// Cosine-distributed direction (Malley's method, polar map).
inline Vec3f cosine_direction(float u, float v) noexcept {
  float c, s;
  turn(v, c, s);
  const float r = std::sqrt(u);
  return {r * c, r * s, std::sqrt(1.0f - u)};
}

/// wi of a GGX lobe by its visible normals: wo is stretched to the hemisphere configuration, where the visible normals
/// of Heitz 2018 are a spherical cap around it (Dupuy and Benyoub 2023, listing 3), and reflected in the normal found.
/// May end below the horizon.
inline Vec3f ggx_direction(const GgxLobe& g, const Vec3f& wo_view, float u, float v) noexcept {
  const Vec3f wo = g.retro ? Vec3f{-wo_view.x, -wo_view.y, wo_view.z} : wo_view;
  const float ex = wo.x * g.alpha, ey = wo.y * g.alpha;
  const float inv = 1.0f / std::sqrt(ex * ex + ey * ey + wo.z * wo.z);
  const float z0 = wo.z * inv;
  float c, s;
  turn(v, c, s);
  const float drop = u * (1.0f + z0);  // 1 - z of the point on the cap; small for normals near the pole
  const float r = std::sqrt(std::max(drop * (2.0f - drop), 0.0f));
  const float hx = (r * c + ex * inv) * g.alpha, hy = (r * s + ey * inv) * g.alpha;
  const float hz = std::max((1.0f - drop) + z0, 0.0f);
  const float h2 = hx * hx + hy * hy + hz * hz;
  // 2 (wo . h) h / |h|^2 - wo: no root, and its length is that of wo
  const float scale = h2 > 0.0f ? 2.0f * (wo.x * hx + wo.y * hy + wo.z * hz) / h2 : 0.0f;
  return {scale * hx - wo.x, scale * hy - wo.y, scale * hz - wo.z};
}

}  // namespace brdf::eval

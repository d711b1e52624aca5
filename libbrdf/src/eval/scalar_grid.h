// SPDX-License-Identifier: Apache-2.0
// Trilinear look-up of the residual ratio for one pair.
#pragma once

#include "eval/grid_params.h"
#include "eval/pair_terms.h"
#include "residual/grid_coordinates.h"
#include "residual/half_float.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace brdf::eval {

/// Lower corner and fractions of a pair in the grid.
struct GridPosition {
  const std::uint16_t* corner;
  float h, d, p;
};

/// Whether cos phi_d, or that of phi_d modulo pi, is not negative. A product, not two signs: with both directions at one
/// height it is 0 either way round.
inline bool on_upper_side(const GridParams& g, const PairTerms& t) noexcept {
  return (g.azimuth == residual::Azimuth::reciprocal ? t.rise * t.cross : t.rise) >= 0.0f;
}

/// Coordinates as residual/grid_coordinates.h defines them, in forms that keep their digits in float:
///   chord(theta) = sqrt(sin^2 / (1 + cos)),   1 - |cos phi_d| = sin^2 phi_d / (1 + |cos phi_d|)
/// with sin phi_d from the cross product, so that neither small angles nor pairs in one plane with the normal cancel.
inline GridPosition grid_position(const GridParams& g, const PairTerms& t) noexcept {
  const float t_h = std::sqrt(t.s_xy2 / (t.s * (t.s + t.s_z)));
  const float t_d = std::sqrt((t.d_xy2 + t.d_z * t.d_z) / (t.norm * (t.norm + t.s)));
  const auto warped = [](float chord, const GridParams::Axis& axis) {
    return chord * (axis.linear + axis.square * chord) / (chord + axis.kappa);
  };
  // cos phi_d : sin phi_d = d_z s : cross. Where both are 0, phi_d has no meaning and cos phi_d = 0 by definition
  const float along = t.d_z * t.s, across2 = t.cross * t.cross + min_denominator;
  const float r = std::sqrt(along * along + across2);
  const float q = std::sqrt(across2 / (r * (r + along)));
  float u_p = q;
  if (g.azimuth != residual::Azimuth::symmetric) u_p = on_upper_side(g, t) ? 0.5f * q : 1.0f - 0.5f * q;

  const float x_h = warped(t_h, g.axis_h), x_d = warped(t_d, g.axis_d), x_p = u_p * g.scale_p;
  const auto lower = [](float x, float last) { return static_cast<float>(static_cast<int>(std::min(x, last))); };
  const float i_h = lower(x_h, g.last_h), i_d = lower(x_d, g.last_d), i_p = lower(x_p, g.last_p);
  const auto node = static_cast<std::ptrdiff_t>((i_h * g.nodes_d + i_d) * g.nodes_p + i_p);
  GridPosition at;
  at.corner = g.ratio + node * g.node_halves;
  at.h = std::min(x_h - i_h, 1.0f);
  at.d = std::min(x_d - i_d, 1.0f);
  at.p = std::min(x_p - i_p, 1.0f);
  return at;
}

/// Eight adjacent halves from `first`, all four (h, d) rows, before interpolation along p. Always eight, so that the
/// compiler turns the loops into vector instructions; the table's padding allows it.
inline void interpolate_rows(const GridParams& g, const GridPosition& at, std::size_t first, float* out) noexcept {
  // the power of two undoes the shift decoding; it sits in the weights so that no product leaves the normal range
  const float w_h1 = at.h * residual::half_exponent_scale, w_h0 = residual::half_exponent_scale - w_h1;
  const float weight[4] = {w_h0 * (1.0f - at.d), w_h0 * at.d, w_h1 * (1.0f - at.d), w_h1 * at.d};
  const std::uint16_t* const corner = at.corner + first;
  const std::uint16_t* const row[4] = {corner, corner + g.step_d, corner + g.step_h, corner + g.step_h + g.step_d};
  float sum[8] = {};
  for (int k = 0; k < 4; ++k) {
    std::uint16_t halves[8];
    std::memcpy(halves, row[k], sizeof halves);
    for (int i = 0; i < 8; ++i)
      sum[i] += weight[k] * std::bit_cast<float>(static_cast<std::uint32_t>(halves[i]) << 13);
  }
  std::memcpy(out, sum, sizeof sum);
}

}  // namespace brdf::eval

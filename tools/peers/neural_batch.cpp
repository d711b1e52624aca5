// SPDX-License-Identifier: Apache-2.0
// The network for two vectors of pairs at a time, so that each weight that is loaded serves both.
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "neural_batch.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "neural_batch.h"

#include <algorithm>

#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "partial_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::peers::HWY_NAMESPACE {

inline constexpr std::size_t hidden = NeuralBrdf::hidden, together = 2;
/// Outputs of a layer that are summed in registers at once.
inline constexpr std::size_t group = 7;

struct Pairs {
  V h_x, h_z, d_x, d_y, d_z;
  hn::Mask<Floats> above;
};

HWY_INLINE Pairs network_inputs(const Directions& wi, const Directions& wo, Azimuth azimuth) {
  const Floats d;
  const V zero = hn::Zero(d), one = set(1.0f), half = set(0.5f);
  const V sx = hn::Add(wi.x, wo.x), sy = hn::Add(wi.y, wo.y), sz = hn::Add(wi.z, wo.z);
  const V dx = hn::Sub(wi.x, wo.x), dy = hn::Sub(wi.y, wo.y), dz = hn::Sub(wi.z, wo.z);
  const V rho2 = hn::MulAdd(sx, sx, hn::Mul(sy, sy)), rho = hn::Sqrt(rho2);
  const V s = hn::Sqrt(hn::MulAdd(sz, sz, rho2));
  const V over_s = hn::Div(one, hn::Max(s, set(1e-30f)));
  const auto pole = hn::Lt(rho, hn::Mul(set(1e-12f), s));  // the azimuth of h has no meaning and counts as 0
  const V over_rho = hn::Div(one, hn::Max(rho, set(1e-30f)));
  const V c = hn::IfThenElse(pole, one, hn::Mul(sx, over_rho)), e = hn::IfThenElse(pole, zero, hn::Mul(sy, over_rho));
  const V along = hn::MulSub(hn::MulAdd(c, dx, hn::Mul(e, dy)), sz, hn::Mul(rho, dz));
  V x = hn::Mul(hn::Mul(along, over_s), half), y = hn::Mul(hn::MulSub(c, dy, hn::Mul(e, dx)), half);
  auto turned = hn::Or(hn::Lt(y, zero), hn::And(hn::Eq(y, zero), hn::Lt(x, zero)));
  if (azimuth == Azimuth::full_circle) turned = hn::Eq(zero, zero);
  x = hn::IfThenElse(turned, hn::Neg(x), x);
  y = hn::IfThenElse(turned, hn::Neg(y), y);
  return {hn::Mul(rho, over_s),
          hn::Mul(sz, over_s),
          x,
          y,
          hn::Mul(s, half),
          hn::And(hn::Gt(wi.z, zero), hn::Gt(wo.z, zero))};
}

/// y[j] = bias[j] + sum over k of weight[row[k] * n_out + j] x[k], for `count` outputs from `first` on.
template <std::size_t count, std::size_t n_in, std::size_t n_out>
HWY_INLINE void sum_outputs(const float* HWY_RESTRICT weight, const float* HWY_RESTRICT bias,
                            const std::size_t (&row)[n_in], std::size_t first, const V (*x)[together],
                            V (*y)[together]) {
  V sum[count][together];
#pragma GCC unroll 7
  for (std::size_t j = 0; j < count; ++j) sum[j][0] = sum[j][1] = set(bias[first + j]);
#pragma GCC unroll 1
  for (std::size_t k = 0; k < n_in; ++k) {
    const float* HWY_RESTRICT w = weight + row[k] * n_out + first;
#pragma GCC unroll 7
    for (std::size_t j = 0; j < count; ++j) {
      const V factor = set(w[j]);
      sum[j][0] = hn::MulAdd(factor, x[k][0], sum[j][0]);
      sum[j][1] = hn::MulAdd(factor, x[k][1], sum[j][1]);
    }
  }
#pragma GCC unroll 7
  for (std::size_t j = 0; j < count; ++j) {
    y[first + j][0] = sum[j][0];
    y[first + j][1] = sum[j][1];
  }
}

HWY_INLINE void rectify(V (*x)[together]) {
  const V zero = hn::Zero(Floats());
  for (std::size_t j = 0; j < hidden; ++j)
    for (std::size_t v = 0; v < together; ++v) x[j][v] = hn::Max(x[j][v], zero);
}

inline constexpr std::size_t input_row[5] = {0, 2, 3, 4, 5};  // the second input, h_y, is always 0
inline constexpr std::size_t hidden_row[hidden] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9, 10,
                                                   11, 12, 13, 14, 15, 16, 17, 18, 19, 20};

void run_network(const float* weights, Azimuth azimuth, const DirectionSpan& wi, const DirectionSpan& wo,
                 PlanarSpan f) {
  constexpr std::size_t n = hidden, channels = NeuralBrdf::channels;
  const float *const w1 = weights, *const b1 = w1 + NeuralBrdf::inputs * n, *const w2 = b1 + n, *const b2 = w2 + n * n,
                     *const w3 = b2 + n, *const b3 = w3 + n * channels;
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t i = 0; i < wi.size; i += together * lanes) {
    V in[5][together], first[n][together], second[n][together], out[channels][together];
    hn::Mask<Floats> above[together];
    std::size_t count[together];
    for (std::size_t v = 0; v < together; ++v) {
      const std::size_t at = std::min(i + v * lanes, wi.size);
      count[v] = std::min(lanes, wi.size - at);
      const Pairs p = network_inputs(load_directions(wi, at, count[v]), load_directions(wo, at, count[v]), azimuth);
      const V values[5] = {p.h_x, p.h_z, p.d_x, p.d_y, p.d_z};
      for (std::size_t k = 0; k < 5; ++k) in[k][v] = values[k];
      above[v] = p.above;
    }
    for (std::size_t j = 0; j < n; j += group) sum_outputs<group, 5, n>(w1, b1, input_row, j, in, first);
    rectify(first);
    for (std::size_t j = 0; j < n; j += group) sum_outputs<group, n, n>(w2, b2, hidden_row, j, first, second);
    rectify(second);
    sum_outputs<channels, n, channels>(w3, b3, hidden_row, 0, second, out);
    for (std::size_t v = 0; v < together; ++v) {
      if (count[v] == 0) break;
      for (std::size_t c = 0; c < channels; ++c) {
        const V clamped = hn::Min(hn::Max(out[c][v], hn::Zero(Floats())), set(50.0f));
        const V value = hn::IfThenElseZero(above[v], hn::Expm1(Floats(), clamped));
        store_first(value, f.data + c * f.stride + i + v * lanes, count[v]);
      }
    }
  }
}

}  // namespace brdf::peers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::peers {

HWY_EXPORT(run_network);

void network_batch(const float* weights, Azimuth azimuth, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept {
  HWY_DYNAMIC_DISPATCH(run_network)(weights, azimuth, wi, wo, f);
}

}  // namespace brdf::peers
#endif

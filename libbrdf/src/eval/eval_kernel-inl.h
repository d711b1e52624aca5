// SPDX-License-Identifier: Apache-2.0
// f of a vector of pairs for any number of channels, times one factor per pair, into planes.
#include "eval/tables.h"

#include <algorithm>

#include "eval/grid_kernel-inl.h"

#if defined(BRDF_EVAL_EVAL_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_EVAL_KERNEL_INL_H_
#undef BRDF_EVAL_EVAL_KERNEL_INL_H_
#else
#define BRDF_EVAL_EVAL_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// `count` values of each channel, from `at` of its plane on.
struct Output {
  PlanarSpan planes;
  std::size_t at, count;
  HWY_INLINE float* channel(std::size_t c) const { return planes.data + c * planes.stride + at; }
};

/// Three channels stay in registers.
HWY_INLINE void eval_rgb(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  V f[3] = {set(t.lobes.lambert[0]), set(t.lobes.lambert[1]), set(t.lobes.lambert[2])};
  const V grazing = for_each_lobe(t.lobes, p, [&f, &t](std::size_t k, V plain) HWY_ATTR {
    for (int c = 0; c < 3; ++c) f[c] = hn::MulAdd(set(t.lobes.ggx[k].f0[c]), plain, f[c]);
  });
  for (int c = 0; c < 3; ++c) f[c] = hn::Add(f[c], grazing);
  if (t.grid.ratio) apply_ratio_rgb(t.grid, p, f);
  for (std::size_t c = 0; c < 3; ++c)
    store_first(hn::IfThenElseZero(p.valid, hn::Mul(f[c], factor)), out.channel(c), out.count);
}

/// Any number of channels without a grid.
HWY_INLINE void eval_lobe_channels(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  V plain[max_ggx_lobes];
  const std::size_t n = t.lobes.ggx.size();
  const V grazing = for_each_lobe(t.lobes, p, [&plain](std::size_t k, V value) HWY_ATTR { plain[k] = value; });
  for (std::size_t c = 0; c < static_cast<std::size_t>(t.lobes.channels); ++c) {
    V sum = hn::Add(set(t.lobes.lambert[c]), grazing);
    for (std::size_t k = 0; k < n; ++k) sum = hn::MulAdd(set(t.lobes.ggx[k].f0[c]), plain[k], sum);
    store_first(hn::IfThenElseZero(p.valid, hn::Mul(sum, factor)), out.channel(c), out.count);
  }
}

/// Eight channels of one pair, from `first` on: lobes and ratio.
struct LaneValues {
  const float* plain;  ///< of each lobe
  float grazing, factor, fraction_p;
};

HWY_INLINE void eval_eight_channels(const Tables& t, const LaneValues& lane, const float* below, const float* above,
                                    std::size_t first, float* HWY_RESTRICT f) {
  for (std::size_t c = 0; c < 8; ++c) f[c] = t.lobes.lambert[first + c] + lane.grazing;
  for (std::size_t k = 0; k < t.lobes.ggx.size(); ++k)
    for (std::size_t c = 0; c < 8; ++c) f[c] += t.lobes.ggx[k].f0[first + c] * lane.plain[k];
  const float epsilon = t.grid.epsilon;
  for (std::size_t c = 0; c < 8; ++c) {
    const float ratio = below[c] + lane.fraction_p * (above[c] - below[c]);
    f[c] = lane.factor * std::max((f[c] + epsilon) * ratio - epsilon, 0.0f);
  }
}

/// Any number of channels with a grid: pair by pair, vectors run along the channels.
HWY_INLINE void eval_grid_channels(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  const Floats d;
  HWY_ALIGN float plain[max_ggx_lobes][max_lanes], grazing[max_lanes], factors[max_lanes], valid[max_lanes];
  const std::size_t n = t.lobes.ggx.size();
  const V bent =
      for_each_lobe(t.lobes, p, [&plain](std::size_t k, V value) HWY_ATTR { hn::Store(value, Floats(), plain[k]); });
  hn::Store(bent, d, grazing);
  hn::Store(factor, d, factors);
  hn::Store(hn::IfThenElseZero(p.valid, set(1.0f)), d, valid);
  GridRows rows;
  grid_rows(t.grid, p, rows);
  const auto channels = static_cast<std::size_t>(t.lobes.channels);
  for (std::size_t i = 0; i < out.count; ++i) {
    float lobe_values[max_ggx_lobes];
    for (std::size_t k = 0; k < n; ++k) lobe_values[k] = plain[k][i];
    const LaneValues lane{lobe_values, grazing[i], factors[i], rows.fraction_p[i]};
    for (std::size_t first = 0; first < channels; first += 8) {
      HWY_ALIGN float below[8], above[8], f[8];
      const auto at = static_cast<std::ptrdiff_t>(first);
      store_eight(rows_of_lane(t.grid, rows, i, at), below);
      store_eight(rows_of_lane(t.grid, rows, i, at + t.grid.step_p), above);
      eval_eight_channels(t, lane, below, above, first, f);
      const std::size_t last = std::min(channels - first, std::size_t{8});
      for (std::size_t c = 0; c < last; ++c) out.channel(first + c)[i] = valid[i] > 0 ? f[c] : 0.0f;
    }
  }
}

HWY_INLINE void eval_pairs(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  if (HWY_LIKELY(t.lobes.channels == 3)) return eval_rgb(t, p, factor, out);
  if (t.grid.ratio) return eval_grid_channels(t, p, factor, out);
  eval_lobe_channels(t, p, factor, out);
}

HWY_INLINE Directions load_directions(const DirectionSpan& w, std::size_t at, std::size_t count) {
  return {load_first(w.x + at, count), load_first(w.y + at, count), load_first(w.z + at, count)};
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

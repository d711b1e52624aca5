// SPDX-License-Identifier: Apache-2.0
// f of a vector of pairs for any number of channels, times one factor per pair, into planes.
#include "eval/tables.h"

#include <algorithm>

#include "eval/grid_kernel-inl.h"
#include "eval/slice_kernel-inl.h"

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

/// Three channels of the lobes.
HWY_INLINE void lobes_rgb(const LobeParams& lobes, const PairVectors& p, V f[3]) {
  for (std::size_t c = 0; c < 3; ++c) f[c] = set(lobes.lambert[c]);
  const V grazing = for_each_lobe(lobes, p, [&lobes, f](std::size_t k, V plain) HWY_ATTR {
    for (int c = 0; c < 3; ++c) f[c] = hn::MulAdd(set(lobes.ggx[k].f0[c]), plain, f[c]);
  });
  for (int c = 0; c < 3; ++c) f[c] = hn::Add(f[c], grazing);
}

HWY_INLINE void eval_lobes_rgb(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  V f[3];
  lobes_rgb(t.lobes, p, f);
  for (std::size_t c = 0; c < 3; ++c)
    store_first(hn::IfThenElseZero(p.valid, hn::Mul(f[c], factor)), out.channel(c), out.count);
}

/// What a block of pairs keeps between the passes over it.
struct BlockRgb {
  GridRows rows;
  HWY_ALIGN float lobes[3][block_pairs];
  HWY_ALIGN float factor[block_pairs];  ///< negative: not valid
  HWY_ALIGN float ratio[4 * block_pairs];
};

/// First pass, vector by vector.
HWY_INLINE void begin_rgb(const Tables& t, const PairVectors& p, V factor, BlockRgb& block, std::size_t at) {
  const Floats d;
  V f[3];
  lobes_rgb(t.lobes, p, f);
  for (std::size_t c = 0; c < 3; ++c) hn::Store(f[c], d, block.lobes[c] + at);
  hn::Store(hn::IfThenElse(p.valid, factor, set(-1.0f)), d, block.factor + at);
  grid_rows(t.grid, p, block.rows, at);
}

/// Writes one vector of the block; `count` is known to the compiler for all but the last.
HWY_INLINE void combine_rgb(const BlockRgb& block, V epsilon, std::size_t at, std::size_t count, const Output& out) {
  const Floats d;
  V r[4];
  hn::LoadInterleaved4(d, block.ratio + 4 * at, r[0], r[1], r[2], r[3]);
  const V factor = hn::Load(d, block.factor + at);
  const auto valid = hn::Ge(factor, hn::Zero(d));
  for (std::size_t c = 0; c < 3; ++c) {
    const V f = with_ratio(hn::Load(d, block.lobes[c] + at), r[c], epsilon);
    store_first(hn::IfThenElseZero(valid, hn::Mul(f, factor)), out.channel(c) + at, count);
  }
}

/// Second pass, pair by pair, and third pass, vector by vector.
HWY_INLINE void finish_rgb(const GridParams& g, BlockRgb& block, const Output& out) {
  const CornerRows corner(g);
  for (std::size_t i = 0; i < out.count; ++i)
    lerp_rgb(rows_of_pair(corner, block.rows, i, 3 * static_cast<std::ptrdiff_t>(block.rows.node[i])),
             block.rows.fraction_p[i], block.ratio + 4 * i);
  const V epsilon = set(g.epsilon);
  const std::size_t lanes = hn::Lanes(Floats());
  std::size_t at = 0;
  for (; at + lanes <= out.count; at += lanes) combine_rgb(block, epsilon, at, lanes, out);
  if (at < out.count) combine_rgb(block, epsilon, at, out.count - at, out);
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

/// Any number of channels with a grid: vectors run along eight channels of one pair, and a tile of eight channels by one
/// vector of pairs goes out together, so that stores to far planes come in whole vectors.
HWY_INLINE void eval_grid_channels(const Tables& t, const PairVectors& p, V factor, const Output& out) {
  const Floats d;
  HWY_ALIGN float plain[max_ggx_lobes][max_lanes], grazing[max_lanes];
  const V bent =
      for_each_lobe(t.lobes, p, [&plain](std::size_t k, V value) HWY_ATTR { hn::Store(value, Floats(), plain[k]); });
  hn::Store(bent, d, grazing);
  GridRows rows;
  grid_rows(t.grid, p, rows, 0);
  const auto channels = static_cast<std::size_t>(t.lobes.channels);
  const std::size_t n = t.lobes.ggx.size();
  HWY_ALIGN float tile[8][max_lanes] = {};
  const CornerRows corner(t.grid);
  for (std::size_t first = 0; first < channels; first += 8) {
    const auto at = static_cast<std::ptrdiff_t>(first);
    for (std::size_t i = 0; i < out.count; ++i) {
      const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(rows.node[i]) * t.grid.node_halves + at;
      const EightFloats below = rows_of_pair(corner, rows, i, offset);
      const EightFloats above = rows_of_pair(corner, rows, i, offset + t.grid.step_p);
      const EightFloats ratio = add_scaled(below, rows.fraction_p[i], subtract(above, below));
      EightFloats f = load_eight(t.lobes.lambert.data() + first, grazing[i]);
      for (std::size_t k = 0; k < n; ++k) f = add_scaled(f, plain[k][i], load_eight(t.lobes.ggx[k].f0 + first, 0.0f));
      float values[8];
      store_eight(with_ratio(f, ratio, t.grid.epsilon), values);
      for (std::size_t c = 0; c < 8; ++c) tile[c][i] = values[c];
    }
    for (std::size_t c = 0; c < std::min(channels - first, std::size_t{8}); ++c)
      store_first(hn::IfThenElseZero(p.valid, hn::Mul(hn::Load(d, tile[c]), factor)), out.channel(first + c), out.count);
  }
}

HWY_INLINE Directions load_directions(const DirectionSpan& w, std::size_t at, std::size_t count) {
  return {load_first(w.x + at, count), load_first(w.y + at, count), load_first(w.z + at, count)};
}

/// The same from a table in slices.
template <class Next>
HWY_INLINE void eval_slices(const slices::SliceView& t, std::size_t n, const PlanarSpan& planes, const Next& next) {
  const std::size_t lanes = hn::Lanes(Floats());
  SliceBlock block;
  HWY_ALIGN float factors[block_pairs];
  for (std::size_t first = 0; first < n; first += block_pairs) {
    const std::size_t size = std::min(block_pairs, n - first);
    for (std::size_t at = 0; at < size; at += lanes) {
      PairVectors p;
      const V factor = next(first + at, std::min(lanes, size - at), p);
      // what is not valid may be no number and must not lead out of the tables: it looks along the normal
      const auto or_normal = [&p](V x, float normal) HWY_ATTR { return hn::IfThenElse(p.valid, x, set(normal)); };
      begin_slices(t, {or_normal(p.wi.x, 0), or_normal(p.wi.y, 0), or_normal(p.wi.z, 1)},
                   {or_normal(p.wo.x, 0), or_normal(p.wo.y, 0), or_normal(p.wo.z, 1)}, block, at);
      hn::Store(hn::IfThenElseZero(p.valid, factor), Floats(), factors + at);
    }
    finish_slices(t, block, factors, size, planes, first);
  }
}

/// f times a factor for `n` pairs. `next(i, count, p)` makes the pairs from i on, at most one vector of them, and returns
/// their factor, not negative.
template <class Next>
HWY_INLINE void eval_pairs(const Tables& t, std::size_t n, PlanarSpan planes, const Next& next) {
  if (t.slices.values) return eval_slices(t.slices, n, planes, next);
  const std::size_t lanes = hn::Lanes(Floats());
  if (t.lobes.channels == 3 && t.grid.ratio) {
    BlockRgb block;
    for (std::size_t first = 0; first < n; first += block_pairs) {
      const std::size_t size = std::min(block_pairs, n - first);
      const auto begin = [&](std::size_t at, std::size_t count) HWY_ATTR __attribute__((always_inline)) {
        PairVectors p;
        const V factor = next(first + at, count, p);
        begin_rgb(t, p, factor, block, at);
      };
      std::size_t at = 0;
      for (; at + lanes <= size; at += lanes) begin(at, lanes);
      if (at < size) {
        std::memset(block.ratio, 0, sizeof block.ratio);  // the last vector reads behind the last pair
        begin(at, size - at);
      }
      finish_rgb(t.grid, block, {planes, first, size});
    }
    return;
  }
  for (std::size_t i = 0; i < n; i += lanes) {
    PairVectors p;
    const Output out{planes, i, std::min(lanes, n - i)};
    const V factor = next(i, out.count, p);
    if (t.grid.ratio)
      eval_grid_channels(t, p, factor, out);
    else if (t.lobes.channels == 3)
      eval_lobes_rgb(t, p, factor, out);
    else
      eval_lobe_channels(t, p, factor, out);
  }
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

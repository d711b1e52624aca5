// SPDX-License-Identifier: Apache-2.0
// The look-up for batches. Positions in the table are computed a vector of pairs at a time; the table is then read pair by
// pair, each of the four rows of two texels with one load. The loads of a block depend on nothing but its positions, so an
// out-of-order processor has those of many pairs on their way at once: software prefetching, with or without a block in
// between, measured 10 % slower from memory and 40 % slower from the cache.
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raw_table_batch.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "raw_table_batch.h"

#include "arc_tangent.h"

#include <algorithm>
#include <cstdint>
#include <numbers>

#include <hwy/highway.h>

#include "partial_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::peers::HWY_NAMESPACE {

/// Many enough that what is stored vector by vector has left the store buffer when it is read pair by pair.
inline constexpr std::size_t block_pairs = 64;

/// Where the pairs of a block lie: lower corner and the weights of the four (theta_h, theta_d) rows.
struct Block {
  std::size_t size = 0;
  HWY_ALIGN std::int32_t corner[block_pairs];
  HWY_ALIGN float weight[4][block_pairs];
  HWY_ALIGN float fraction_p[block_pairs];
  HWY_ALIGN float inside[block_pairs];  ///< 1 above the horizon, 0 below
};

/// 1 / sqrt(x) to about 22 bits for x of at least 1e-30: the processor's estimate and a step of Newton's method, which
/// take a fraction of the time of its roots and quotients.
HWY_INLINE V reciprocal_root(V x) {
  const V y = hn::ApproximateReciprocalSqrt(x);
  return hn::Mul(y, hn::NegMulAdd(hn::Mul(hn::Mul(x, set(0.5f)), y), y, set(1.5f)));
}

HWY_INLINE V not_zero(V x) { return hn::Max(x, set(1e-30f)); }

/// Angle of (x, y) in [0, pi / 2] from the squares of x and y.
HWY_INLINE V first_quadrant_angle(V y2, V x2) {
  const V less = hn::Min(x2, y2);
  const V r = hn::Mul(less, reciprocal_root(not_zero(hn::Mul(x2, y2))));  // sqrt(less / more)
  const V r2 = hn::Mul(r, r);
  V p = set(arc_tangent_series.back());
  for (std::size_t k = arc_tangent_series.size() - 1; k-- > 0;) p = hn::MulAdd(p, r2, set(arc_tangent_series[k]));
  const V angle = hn::MulAdd(hn::Mul(p, r2), r, r);
  constexpr float quarter = static_cast<float>(std::numbers::pi / 2);
  return hn::IfThenElse(hn::Gt(y2, x2), hn::Sub(set(quarter), angle), angle);
}

struct AxisPosition {
  VI lower;
  V fraction;
};

/// Whole part of `x`, at least 0 and at most `most` whatever `x` is, and the rest.
HWY_INLINE AxisPosition split(V x, std::int32_t most) {
  const Ints di;
  const VI lower = hn::Min(hn::Max(hn::ConvertTo(di, x), hn::Zero(di)), hn::Set(di, most));
  return {lower, hn::Sub(x, hn::ConvertTo(Floats(), lower))};
}

/// Between node 0 and node `last`.
HWY_INLINE AxisPosition axis_position(V x, std::int32_t last) {
  return split(hn::Min(hn::Max(x, hn::Zero(Floats())), set(static_cast<float>(last))), last - 1);
}

/// On a circle of `n` bins, whose row holds its first texel at the end once more.
HWY_INLINE AxisPosition circle_position(V x, std::int32_t n) {
  const Floats d;
  const V size = set(static_cast<float>(n));
  const V within = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Add(x, size), x);
  return split(hn::IfThenElse(hn::Ge(within, size), hn::Sub(within, size), within), n - 1);
}

/// Bins of phi_d of the difference direction (x, y) in the frame of the half vector.
HWY_INLINE V azimuth_bins(const RawTableView& t, V x, V y) {
  const Floats d;
  const V zero = hn::Zero(d);
  constexpr float pi = std::numbers::pi_v<float>;
  const V angle = first_quadrant_angle(hn::Mul(y, y), hn::Mul(x, x));
  const auto opposite = hn::Xor(hn::Lt(x, zero), hn::Lt(y, zero));               // of the signs of x and y
  const V half_turn = hn::IfThenElse(opposite, hn::Sub(set(pi), angle), angle);  // phi_d modulo pi
  if (!t.full_circle) return hn::Mul(half_turn, set(static_cast<float>(t.n_p) / pi));
  const V turn = hn::IfThenElse(hn::Lt(y, zero), hn::Add(half_turn, set(pi)), half_turn);
  return hn::Mul(turn, set(static_cast<float>(t.n_p) / (2 * pi)));
}

/// Fills one vector of the block, from pair `at` of it on.
HWY_INLINE void find_positions(const RawTableView& t, const Directions& wi, const Directions& wo, Block& block,
                               std::size_t at) {
  const Floats d;
  const V zero = hn::Zero(d), one = set(1.0f);
  const auto inside = hn::And(hn::Gt(wi.z, zero), hn::Gt(wo.z, zero));
  const V sx = hn::Add(wi.x, wo.x), sy = hn::Add(wi.y, wo.y), sz = hn::Add(wi.z, wo.z);
  const V dx = hn::Sub(wi.x, wo.x), dy = hn::Sub(wi.y, wo.y), dz = hn::Sub(wi.z, wo.z);
  const V rho2 = hn::MulAdd(sx, sx, hn::Mul(sy, sy));
  const V s2 = hn::MulAdd(sz, sz, rho2), d2 = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
  const V s = hn::Mul(s2, reciprocal_root(not_zero(s2)));

  // the difference direction in the frame of the half vector, times |wi + wo| and the sine of theta_h, which only turns
  // it when the half vector is the normal
  const auto pole = hn::Lt(rho2, hn::Mul(set(1e-24f), s2));
  const V c = hn::IfThenElse(pole, one, sx), e = hn::IfThenElse(pole, zero, sy);
  const V x = hn::MulSub(hn::MulAdd(c, dx, hn::Mul(e, dy)), sz, hn::Mul(rho2, dz));
  const V y = hn::Mul(hn::MulSub(c, dy, hn::Mul(e, dx)), s);

  constexpr float quarter = static_cast<float>(std::numbers::pi / 2);
  const V offset = set(t.offset);
  const V theta_h = not_zero(first_quadrant_angle(rho2, hn::Mul(sz, sz))), theta_d = first_quadrant_angle(d2, s2);
  const V root = hn::Mul(theta_h, reciprocal_root(theta_h));
  const V bins_h = hn::Mul(root, set(static_cast<float>(t.n_h * std::numbers::sqrt2 * std::numbers::inv_sqrtpi)));
  const V bins_d = hn::Mul(theta_d, set(static_cast<float>(t.n_d) / quarter));
  const AxisPosition h = axis_position(hn::Sub(bins_h, offset), t.n_h - 1);
  const AxisPosition v = axis_position(hn::Sub(bins_d, offset), t.n_d - 1);
  const AxisPosition p = circle_position(hn::Sub(azimuth_bins(t, x, y), offset), t.n_p);

  const Ints di;
  const VI corner = hn::Add(hn::Add(hn::Mul(h.lower, hn::Set(di, t.step_h)), hn::Mul(v.lower, hn::Set(di, t.step_d))),
                            hn::Mul(p.lower, hn::Set(di, 3)));
  // masked, because a pair below the horizon may be no number and must not lead out of the table
  hn::Store(hn::IfThenElseZero(hn::RebindMask(di, inside), corner), di, block.corner + at);
  hn::Store(hn::IfThenElseZero(inside, one), d, block.inside + at);
  hn::Store(p.fraction, d, block.fraction_p + at);
  const V h0 = hn::Sub(one, h.fraction), v0 = hn::Sub(one, v.fraction);
  hn::Store(hn::Mul(h0, v0), d, block.weight[0] + at);
  hn::Store(hn::Mul(h0, v.fraction), d, block.weight[1] + at);
  hn::Store(hn::Mul(h.fraction, v0), d, block.weight[2] + at);
  hn::Store(hn::Mul(h.fraction, v.fraction), d, block.weight[3] + at);
}

/// Positions of the pairs from `first` on.
HWY_INLINE void begin_block(const RawTableView& t, const DirectionSpan& wi, const DirectionSpan& wo, std::size_t first,
                            Block& block) {
  const std::size_t lanes = hn::Lanes(Floats());
  block.size = std::min(block_pairs, wi.size - first);
  for (std::size_t at = 0; at < block.size; at += lanes) {
    const std::size_t count = std::min(lanes, block.size - at);
    find_positions(t, load_directions(wi, first + at, count), load_directions(wo, first + at, count), block, at);
  }
}

// The vectors of the compiler (gcc, clang), which it splits into those of the processor.
typedef float Float8 __attribute__((vector_size(32)));
typedef float Float4 __attribute__((vector_size(16)));

HWY_INLINE void finish_block(const RawTableView& t, const Block& block, PlanarSpan f, std::size_t first) {
  const Floats d;
  HWY_ALIGN float rgb[4 * block_pairs];
  std::memset(rgb + 4 * block.size, 0, 4 * (block_pairs - block.size) * sizeof(float));  // the last vector reads them
  for (std::size_t i = 0; i < block.size; ++i) {
    const float* corner = t.texels + block.corner[i];
    Float8 row[4];
    std::memcpy(&row[0], corner, sizeof row[0]);
    std::memcpy(&row[1], corner + t.step_d, sizeof row[1]);
    std::memcpy(&row[2], corner + t.step_h, sizeof row[2]);
    std::memcpy(&row[3], corner + t.step_h + t.step_d, sizeof row[3]);
    const Float8 sum = (row[0] * block.weight[0][i] + row[1] * block.weight[1][i]) +
                       (row[2] * block.weight[2][i] + row[3] * block.weight[3][i]);
    const Float4 below = __builtin_shufflevector(sum, sum, 0, 1, 2, 3);
    const Float4 above = __builtin_shufflevector(sum, sum, 3, 4, 5, 6);
    const Float4 value = below + (above - below) * block.fraction_p[i];
    std::memcpy(rgb + 4 * i, &value, sizeof value);
  }
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t at = 0; at < block.size; at += lanes) {
    V value[4];
    hn::LoadInterleaved4(d, rgb + 4 * at, value[0], value[1], value[2], value[3]);
    const auto inside = hn::Gt(hn::Load(d, block.inside + at), hn::Zero(d));
    for (std::size_t c = 0; c < 3; ++c) {
      store_first(hn::IfThenElseZero(inside, hn::Max(value[c], hn::Zero(d))), f.data + c * f.stride + first + at,
                  std::min(lanes, block.size - at));
    }
  }
}

void look_up(const RawTableView& t, const DirectionSpan& wi, const DirectionSpan& wo, PlanarSpan f) {
  Block block;
  for (std::size_t first = 0; first < wi.size; first += block_pairs) {
    begin_block(t, wi, wo, first, block);
    finish_block(t, block, f, first);
  }
}

}  // namespace brdf::peers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::peers {

HWY_EXPORT(look_up);

void look_up_batch(const RawTableView& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept {
  HWY_DYNAMIC_DISPATCH(look_up)(t, wi, wo, f);
}

}  // namespace brdf::peers
#endif

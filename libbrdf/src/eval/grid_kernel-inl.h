// SPDX-License-Identifier: Apache-2.0
// Trilinear look-up of the residual ratio for a vector of pairs. Coordinates are computed for all pairs at once, as in
// eval/scalar_grid.h; the table is then read pair by pair in whole rows of adjacent halves. One 16-byte load brings what
// several element gathers would, and gathers are slow on processors with the mitigation of Gather Data Sampling.
#include "eval/tables.h"
#include "residual/grid_coordinates.h"
#include "residual/half_float.h"

#include "eval/lobe_kernel-inl.h"

#if defined(BRDF_EVAL_GRID_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_GRID_KERNEL_INL_H_
#undef BRDF_EVAL_GRID_KERNEL_INL_H_
#else
#define BRDF_EVAL_GRID_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// For each lane: index of the lower corner node, weights of the four (h, d) rows (they hold the power of two that
/// completes the decoding of halves), and the fraction along p.
struct GridRows {
  HWY_ALIGN std::int32_t node[max_lanes];
  HWY_ALIGN float weight[4][max_lanes];
  HWY_ALIGN float fraction_p[max_lanes];
};

struct AxisPosition {
  V lower, fraction;
};

HWY_INLINE AxisPosition axis_position(V u, float scale, float last) {
  const V x = hn::Mul(u, set(scale));
  const V lower = hn::Floor(hn::Min(x, set(last)));
  return {lower, hn::Min(hn::Sub(x, lower), set(1.0f))};
}

HWY_INLINE V warped(V t, float a, float kappa) {
  constexpr float b = static_cast<float>(1 - residual::warp_share);
  return hn::Mul(t, hn::MulAdd(set(a), reciprocal(hn::Add(t, set(kappa))), set(b)));
}

HWY_INLINE V root_of_quotient(V a, V b) { return root(hn::Max(hn::Mul(a, reciprocal(b)), set(min_denominator))); }

HWY_INLINE void grid_rows(const GridParams& g, const PairVectors& p, GridRows& rows) {
  const Floats d;
  const V d2 = hn::MulAdd(p.d_z, p.d_z, p.d_xy2);
  const V t_h = root_of_quotient(p.s_xy2, hn::Mul(p.s, hn::Add(p.s, p.s_z)));
  const V t_d = root_of_quotient(d2, hn::Mul(p.norm, hn::Add(p.norm, p.s)));
  const V along = hn::Mul(p.d_z, p.s), across2 = hn::MulAdd(p.cross, p.cross, set(min_denominator));
  const V r = root(hn::MulAdd(along, along, across2));
  const V q = root_of_quotient(across2, hn::Mul(r, hn::Add(r, along)));
  V u_p = q;
  if (!g.reciprocal) {
    const V half = hn::Mul(q, set(0.5f));
    u_p = hn::IfThenElse(hn::Ge(p.cos_o, p.cos_i), half, hn::Sub(set(1.0f), half));
  }
  const AxisPosition at_h = axis_position(warped(t_h, g.warp_a_h, g.kappa_h), g.scale_h, g.last_h);
  const AxisPosition at_d = axis_position(warped(t_d, g.warp_a_d, g.kappa_d), g.scale_d, g.last_d);
  const AxisPosition at_p = axis_position(u_p, g.scale_p, g.last_p);

  // masked, because a pair that is not valid may be no number and must not lead out of the table
  const V node = hn::IfThenElseZero(
      p.valid, hn::MulAdd(hn::MulAdd(at_h.lower, set(g.nodes_d), at_d.lower), set(g.nodes_p), at_p.lower));
  hn::Store(hn::ConvertTo(Ints(), node), Ints(), rows.node);
  hn::Store(at_p.fraction, d, rows.fraction_p);
  const V scale = set(residual::half_exponent_scale);
  const V h1 = hn::Mul(at_h.fraction, scale), h0 = hn::Sub(scale, h1);
  const V w1 = hn::Mul(h0, at_d.fraction), w3 = hn::Mul(h1, at_d.fraction);
  hn::Store(hn::Sub(h0, w1), d, rows.weight[0]);
  hn::Store(w1, d, rows.weight[1]);
  hn::Store(hn::Sub(h1, w3), d, rows.weight[2]);
  hn::Store(w3, d, rows.weight[3]);
}

/// Eight adjacent halves.
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
using Eight = hn::FixedTag<float, 8>;
struct EightFloats {
  hn::Vec<Eight> v;
};

HWY_INLINE hn::Vec<Eight> eight_halves(const std::uint16_t* p) {
  const hn::FixedTag<std::uint32_t, 8> wide;
  const auto bits = hn::PromoteTo(wide, hn::LoadU(hn::FixedTag<std::uint16_t, 8>(), p));
  return hn::BitCast(Eight(), hn::ShiftLeft<13>(bits));
}

/// sum of weight[k] times the halves at row[k]
HWY_INLINE EightFloats weighted_rows(const std::uint16_t* const row[4], const float weight[4]) {
  const Eight d;
  auto sum = hn::Mul(hn::Set(d, weight[0]), eight_halves(row[0]));
  for (int k = 1; k < 4; ++k) sum = hn::MulAdd(hn::Set(d, weight[k]), eight_halves(row[k]), sum);
  return {sum};
}

/// out[c] = sum[c] + fraction (sum[c + 3] - sum[c]) for c < 3; writes four floats.
HWY_INLINE void lerp_rgb(const EightFloats& sum, float fraction, float* HWY_RESTRICT out) {
  const Eight d;
  HWY_ALIGN static constexpr std::int32_t next[8] = {3, 4, 5, 5, 5, 5, 5, 5};
  const auto above = hn::TableLookupLanes(sum.v, hn::SetTableIndices(d, next));
  const hn::FixedTag<float, 4> four;
  const auto below = hn::LowerHalf(four, sum.v);
  hn::StoreU(hn::MulAdd(hn::Set(four, fraction), hn::Sub(hn::LowerHalf(four, above), below), below), four, out);
}

HWY_INLINE void store_eight(const EightFloats& sum, float* HWY_RESTRICT out) { hn::StoreU(sum.v, Eight(), out); }
#else
struct EightFloats {
  float v[8];
};

HWY_INLINE EightFloats weighted_rows(const std::uint16_t* const row[4], const float weight[4]) {
  EightFloats sum = {};
  for (int k = 0; k < 4; ++k) {
    std::uint16_t halves[8];
    std::memcpy(halves, row[k], sizeof halves);
    for (int i = 0; i < 8; ++i) {
      const std::uint32_t bits = static_cast<std::uint32_t>(halves[i]) << 13;
      float value;
      std::memcpy(&value, &bits, sizeof value);
      sum.v[i] += weight[k] * value;
    }
  }
  return sum;
}

HWY_INLINE void lerp_rgb(const EightFloats& sum, float fraction, float* HWY_RESTRICT out) {
  for (int c = 0; c < 3; ++c) out[c] = sum.v[c] + fraction * (sum.v[c + 3] - sum.v[c]);
  out[3] = 0;
}

HWY_INLINE void store_eight(const EightFloats& sum, float* HWY_RESTRICT out) { std::memcpy(out, sum.v, sizeof sum.v); }
#endif

/// The four (h, d) rows of lane `i`, from half `first` of the node on.
HWY_INLINE EightFloats rows_of_lane(const GridParams& g, const GridRows& rows, std::size_t i, std::ptrdiff_t first) {
  const std::uint16_t* corner = g.ratio + static_cast<std::ptrdiff_t>(rows.node[i]) * g.node_halves + first;
  const std::uint16_t* const row[4] = {corner, corner + g.step_d, corner + g.step_h, corner + g.step_h + g.step_d};
  const float weight[4] = {rows.weight[0][i], rows.weight[1][i], rows.weight[2][i], rows.weight[3][i]};
  return weighted_rows(row, weight);
}

/// max(0, (lobes + epsilon) ratio - epsilon)
HWY_INLINE V with_ratio(V lobes, V ratio, V epsilon) {
  return hn::Max(hn::MulSub(hn::Add(lobes, epsilon), ratio, epsilon), hn::Zero(Floats()));
}

/// Multiplies three channels by the ratio. The six halves of two neighbours along p are adjacent.
HWY_INLINE void apply_ratio_rgb(const GridParams& g, const PairVectors& p, V f[3]) {
  const Floats d;
  GridRows rows;
  grid_rows(g, p, rows);
  HWY_ALIGN float ratio[4 * max_lanes];
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < lanes; ++i) lerp_rgb(rows_of_lane(g, rows, i, 0), rows.fraction_p[i], ratio + 4 * i);
  V r[4];
  hn::LoadInterleaved4(d, ratio, r[0], r[1], r[2], r[3]);
  const V epsilon = set(g.epsilon);
  for (int c = 0; c < 3; ++c) f[c] = with_ratio(f[c], r[c], epsilon);
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

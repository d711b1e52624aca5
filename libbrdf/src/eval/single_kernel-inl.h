// SPDX-License-Identifier: Apache-2.0
// f of one RGB pair: lobes in the lanes of a vector, the axes of the grid in those of another. A single call waits for one
// result after the other, and lanes bring as many of them at once as they can.
#include "eval/pair_terms.h"
#include "eval/scalar_grid.h"
#include "eval/tables.h"

#include <numbers>

#include "eval/eight_floats-inl.h"

#if defined(BRDF_EVAL_SINGLE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_SINGLE_KERNEL_INL_H_
#undef BRDF_EVAL_SINGLE_KERNEL_INL_H_
#else
#define BRDF_EVAL_SINGLE_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

using Four = hn::FixedTag<float, 4>;
using V4 = hn::Vec<Four>;

HWY_INLINE V4 four(float x) { return hn::Set(Four(), x); }
HWY_INLINE V4 four(const std::array<float, 4>& x) { return hn::LoadU(Four(), x.data()); }

/// Put together in registers: a wide load waits for narrow stores to reach the cache.
HWY_INLINE V4 four(float a, float b, float c, float e) {
  const Four d;
  return hn::ConcatLowerLower(d, hn::InterleaveLower(d, four(c), four(e)), hn::InterleaveLower(d, four(a), four(b)));
}

/// Four lobes without colour; formulas as in eval/scalar_eval.cpp.
HWY_INLINE void four_lobes(const FourLobes& g, const PairTerms& p, V4 schlick, V4& plain, V4& grazing) {
  constexpr float scaled_half_inv_pi = static_cast<float>(0.5 * std::numbers::inv_pi) * ndf_scale * ndf_scale;
  const auto retro = hn::Gt(four(g.retro), hn::Zero(Four()));
  const V4 in_plane = hn::IfThenElse(retro, four(p.d_xy2), four(p.s_xy2)), s_z2 = four(p.s_z2);
  const V4 s2 = hn::Add(in_plane, s_z2), alpha2 = four(g.alpha2), rest = four(g.one_minus_alpha2);
  const V4 den = hn::MulAdd(in_plane, four(g.inv_alpha), hn::Mul(s_z2, four(g.alpha)));
  const V4 of_high = hn::Sqrt(hn::MulAdd(rest, four(p.high * p.high), alpha2));
  const V4 of_low = hn::Sqrt(hn::MulAdd(rest, four(p.low * p.low), alpha2));
  const V4 shadowing = hn::MulAdd(four(p.low), of_high, hn::Mul(four(p.high), of_low));
  const V4 divisor = hn::Mul(hn::Mul(den, den), hn::Max(shadowing, four(g.least_shadowing)));
  const V4 value = hn::Div(hn::Mul(hn::Mul(s2, s2), four(scaled_half_inv_pi)), divisor);
  // lane 0 of schlick is for reflection lobes, lane 1 for retro lobes
  const V4 fresnel = hn::IfThenElse(retro, hn::Broadcast<1>(schlick), hn::Broadcast<0>(schlick));
  const V4 bent = hn::Mul(value, fresnel);
  plain = hn::Sub(value, bent);
  grazing = hn::MulAdd(four(g.f90), bent, grazing);
}

/// Lobes of a pair; lane 3 has no meaning.
HWY_INLINE V4 lobes_of_pair(const LobeParams& lobes, const PairTerms& p) {
  const float back = lobes.forward_count < lobes.ggx.size() ? std::sqrt(p.d_xy2 + p.s_z2) : 0.0f;
  const V4 cosines = hn::Mul(hn::InterleaveLower(Four(), four(p.s), four(back)), four(p.inv_norm));
  const V4 m = hn::Max(hn::Sub(four(1.0f), cosines), hn::Zero(Four())), m2 = hn::Mul(m, m);
  const V4 schlick = hn::Mul(hn::Mul(m2, m2), m);
  V4 f = hn::LoadU(Four(), lobes.lambert.data()), grazing = hn::Zero(Four());
  const float* f0 = lobes.f0.data();
  const std::size_t step = lobes.padded_channels;
  for (const FourLobes& g : lobes.fours) {
    V4 plain;
    four_lobes(g, p, schlick, plain, grazing);
    f = hn::MulAdd(hn::Broadcast<0>(plain), hn::LoadU(Four(), f0), f);
    f = hn::MulAdd(hn::Broadcast<1>(plain), hn::LoadU(Four(), f0 + step), f);
    f = hn::MulAdd(hn::Broadcast<2>(plain), hn::LoadU(Four(), f0 + 2 * step), f);
    f = hn::MulAdd(hn::Broadcast<3>(plain), hn::LoadU(Four(), f0 + 3 * step), f);
    f0 += 4 * step;
  }
  return hn::Add(f, hn::SumOfLanes(Four(), grazing));
}

/// Ratio of a pair; coordinates as in eval/scalar_grid.h.
HWY_INLINE V4 ratio_of_pair(const GridParams& g, const PairTerms& t) {
  const Four d;
  // r from |s|^2, so that its root need not wait for that of |s|
  const float along = t.d_z * t.s, across2 = t.cross * t.cross + min_denominator;
  const float r = std::sqrt((t.d_z * t.d_z) * t.s2 + across2);
  const V4 above = four(t.s_xy2, t.d_xy2 + t.d_z * t.d_z, across2, 0.0f);
  const V4 below = four(t.s * (t.s + t.s_z), t.norm * (t.norm + t.s), r * (r + along), 1.0f);
  const V4 chord = hn::Sqrt(hn::Div(above, below));
  const GridParams::AxisLanes& a = g.lanes;
  const GridParams::AxisLanes::Side& side = a.side[on_upper_side(g, t) ? 1 : 0];
  const V4 divisor = hn::Add(chord, four(a.kappa)), bent = hn::MulAdd(chord, four(side.square), four(side.linear));
  const V4 x = hn::Div(hn::MulAdd(chord, bent, hn::Mul(divisor, four(side.offset))), divisor);
  const hn::FixedTag<std::int32_t, 4> ints;
  const auto lower = hn::ConvertTo(ints, hn::Min(x, four(a.last)));
  const std::int32_t offset = hn::GetLane(hn::SumOfLanes(ints, hn::Mul(lower, hn::LoadU(ints, a.halves.data()))));
  HWY_ALIGN float fraction[4];
  hn::Store(hn::Min(hn::Sub(x, hn::ConvertTo(d, lower)), four(1.0f)), d, fraction);
  const float h1 = fraction[0] * row_scale, h0 = row_scale - h1, w1 = h0 * fraction[1], w3 = h1 * fraction[1];
  const float weight[4] = {h0 - w1, w1, h1 - w3, w3};
  const std::uint16_t* const row[4] = {g.ratio, g.ratio + g.step_d, g.ratio + g.step_h, g.ratio + g.step_h + g.step_d};
  const EightFloats sum = weighted_rows(row, offset, weight, 1);
  HWY_ALIGN float ratio[4];
  lerp_rgb(sum, fraction[2], ratio);
  return hn::Load(d, ratio);
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

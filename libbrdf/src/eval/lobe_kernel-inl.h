// SPDX-License-Identifier: Apache-2.0
// A vector of pairs: their geometry and the lobes' values. The formulas, and why they are symmetric to the last bit, are
// those of eval/pair_terms.h and eval/scalar_eval.cpp.
#include "eval/pair_terms.h"
#include "eval/tables.h"

#include <numbers>

#include "eval/vectors-inl.h"

#if defined(BRDF_EVAL_LOBE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_LOBE_KERNEL_INL_H_
#undef BRDF_EVAL_LOBE_KERNEL_INL_H_
#else
#define BRDF_EVAL_LOBE_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// Pairs that go through the passes of a kernel together. Many enough that what is stored vector by vector and read pair
/// by pair, and the other way round, has left the store buffer, which cannot forward a wide load from several narrow
/// stores; few enough to stay in the first cache.
inline constexpr std::size_t block_pairs = 64;

struct Directions {
  V x, y, z;
};

struct PairVectors {
  Directions wi, wo;
  V cos_i, cos_o, low, high;
  V s_xy2, d_xy2, s_z, s_z2, d_z, cross;
  V s2, s, norm, inv_norm;
  hn::Mask<Floats> valid;
};

HWY_INLINE PairVectors pair_vectors(const Directions& wi, const Directions& wo) {
  PairVectors p;
  p.wi = wi;
  p.wo = wo;
  const V sx = hn::Add(wi.x, wo.x), sy = hn::Add(wi.y, wo.y), dx = hn::Sub(wi.x, wo.x), dy = hn::Sub(wi.y, wo.y);
  p.cos_i = wi.z;
  p.cos_o = wo.z;
  p.low = hn::Max(hn::Min(wi.z, wo.z), set(min_cosine));
  p.high = hn::Max(hn::Max(wi.z, wo.z), set(min_cosine));
  p.s_xy2 = hn::MulAdd(sx, sx, hn::Mul(sy, sy));
  p.d_xy2 = hn::MulAdd(dx, dx, hn::Mul(dy, dy));
  p.s_z = hn::Add(p.low, p.high);
  p.s_z2 = hn::Mul(p.s_z, p.s_z);
  p.d_z = hn::Sub(p.high, p.low);
  p.cross = hn::MulSub(sx, dy, hn::Mul(sy, dx));
  p.s2 = hn::Add(p.s_xy2, p.s_z2);
  const V norm2 = hn::Add(p.s2, hn::MulAdd(p.d_z, p.d_z, p.d_xy2));
  p.s = hn::Sqrt(p.s2);
  p.norm = hn::MulAdd(norm2, set(0.25f), set(1.0f));
  p.inv_norm = hn::NegMulAdd(norm2, set(0.0625f), set(0.75f));
  // each cosine by itself: a minimum may hide one that is no number
  const V zero = hn::Zero(Floats());
  p.valid = hn::And(hn::And(hn::Gt(wi.z, zero), hn::Gt(wo.z, zero)), hn::Lt(norm2, set(max_norm2)));
  return p;
}

HWY_INLINE V schlick_weights(V cos_theta_d) {
  const V m = hn::Max(hn::Sub(set(1.0f), cos_theta_d), hn::Zero(Floats())), m2 = hn::Mul(m, m);
  return hn::Mul(hn::Mul(m2, m2), m);
}

/// |s|^4 / (2 pi), scaled: what the normal distributions of all lobes with one half vector share.
HWY_INLINE V ndf_numerator(V in_plane, V s_z2) {
  constexpr float scaled_half_inv_pi = static_cast<float>(0.5 * std::numbers::inv_pi) * ndf_scale * ndf_scale;
  const V s2 = hn::Add(in_plane, s_z2);
  return hn::Mul(hn::Mul(s2, s2), set(scaled_half_inv_pi));
}

/// numerator / (denominator^2 divisor) of one lobe.
HWY_INLINE V ndf_quotient(const GgxLobe& g, V numerator, V in_plane, V s_z2, V divisor) {
  const V den = hn::MulAdd(in_plane, set(g.inv_alpha), hn::Mul(s_z2, set(g.alpha)));
  return quotient(numerator, hn::Mul(hn::Mul(den, den), divisor));
}

/// sqrt(alpha^2 + (1 - alpha^2) cos^2)
HWY_INLINE V slope_length(const GgxLobe& g, V cos2) {
  return root(hn::MulAdd(set(g.one_minus_alpha2), cos2, set(g.alpha2)));
}

/// `each(k, plain)` for the lobes from `first` to `last`, which share a half vector; adds to `grazing`.
template <class Each>
HWY_INLINE void for_lobes(const LobeParams& lobes, std::size_t first, std::size_t last, const PairVectors& p, V in_plane,
                          V s, V& grazing, Each&& each) {
  const V low2 = hn::Mul(p.low, p.low), high2 = hn::Mul(p.high, p.high);
  const V fresnel = schlick_weights(hn::Mul(s, p.inv_norm)), numerator = ndf_numerator(in_plane, p.s_z2);
  for (std::size_t k = first; k < last; ++k) {
    const GgxLobe& g = lobes.ggx[k];
    const V shadowing = hn::MulAdd(p.low, slope_length(g, high2), hn::Mul(p.high, slope_length(g, low2)));
    const V value = ndf_quotient(g, numerator, in_plane, p.s_z2, hn::Max(shadowing, set(g.least_shadowing)));
    const V bent = hn::Mul(value, fresnel);
    grazing = hn::MulAdd(set(g.f90), bent, grazing);
    each(k, hn::Sub(value, bent));
  }
}

/// Calls `each(k, plain)` for every GGX lobe: f_c = lambert_c + sum_k f0_kc plain_k + the value returned.
template <class Each>
HWY_INLINE V for_each_lobe(const LobeParams& lobes, const PairVectors& p, Each&& each) {
  V grazing = hn::Zero(Floats());
  const std::size_t turn = lobes.forward_count, end = lobes.ggx.size();
  for_lobes(lobes, 0, turn, p, p.s_xy2, p.s, grazing, each);
  if (HWY_UNLIKELY(turn < end))
    for_lobes(lobes, turn, end, p, p.d_xy2, hn::Sqrt(hn::Add(p.d_xy2, p.s_z2)), grazing, each);
  return grazing;
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

// SPDX-License-Identifier: Apache-2.0
// A vector of pairs: their geometry, the lobes' values and the density of the sampling mixture. The formulas, and why
// they are symmetric to the last bit, are those of eval/pair_terms.h and eval/scalar_eval.cpp.
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

/// |s|^4 / (2 pi): what the normal distributions of all lobes with one half vector share.
HWY_INLINE V ndf_numerator(V in_plane, V s_z2) {
  constexpr float half_inv_pi = static_cast<float>(0.5 * std::numbers::inv_pi);
  const V s2 = hn::Add(in_plane, s_z2);
  return hn::Mul(hn::Mul(s2, s2), set(half_inv_pi));
}

/// numerator / (denominator^2 divisor) of one lobe.
HWY_INLINE V guarded_quotient(const GgxLobe& g, V numerator, V in_plane, V s_z2, V divisor) {
  const V den = hn::MulAdd(in_plane, set(g.inv_alpha), hn::Mul(s_z2, set(g.alpha)));
  return quotient(numerator, hn::Max(hn::Mul(hn::Mul(den, den), divisor), set(min_denominator)));
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
    const V value = guarded_quotient(g, numerator, in_plane, p.s_z2, shadowing);
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

/// Bernstein basis of the mixture weights; see eval/mixture.h.
struct BernsteinVectors {
  V power[Mixture::controls];
};

HWY_INLINE BernsteinVectors bernstein_vectors(V cos_o) {
  const V x = hn::Min(cos_o, set(1.0f)), y = hn::Sub(set(1.0f), x);
  const V x2 = hn::Mul(x, x), y2 = hn::Mul(y, y), x4 = hn::Mul(x2, x2), y4 = hn::Mul(y2, y2);
  const V x3 = hn::Mul(x2, x), y3 = hn::Mul(y2, y);
  return {{hn::Mul(y4, y), hn::Mul(y4, x), hn::Mul(y3, x2), hn::Mul(y2, x3), hn::Mul(y, x4), hn::Mul(x4, x)}};
}

HWY_INLINE V mixture_weights(const Mixture::Curve& curve, const BernsteinVectors& b) {
  V w = hn::Mul(set(curve[0]), b.power[0]);
  for (std::size_t j = 1; j < Mixture::controls; ++j) w = hn::MulAdd(set(curve[j]), b.power[j], w);
  return w;
}

/// Adds the densities of the lobes from `first` to `last`, which share a half vector; takes their weights from `rest`.
HWY_INLINE void add_densities(const Tables& t, std::size_t first, std::size_t last, const PairVectors& p,
                              const BernsteinVectors& basis, V in_plane, V& rest, V& density) {
  const V numerator = ndf_numerator(in_plane, p.s_z2), cos_o2 = hn::Mul(p.cos_o, p.cos_o);
  for (std::size_t k = first; k < last; ++k) {
    const GgxLobe& g = t.lobes.ggx[k];
    const V w = mixture_weights(t.mixture.lobe[k], basis);
    rest = hn::Sub(rest, w);
    const V one_sided = hn::Add(p.cos_o, slope_length(g, cos_o2));
    density = hn::MulAdd(w, guarded_quotient(g, numerator, in_plane, p.s_z2, one_sided), density);
  }
}

/// Density of the mixture at cos_i given cos_o; 0 for pairs that are not valid.
HWY_INLINE V mixture_density(const Tables& t, const PairVectors& p) {
  const BernsteinVectors basis = bernstein_vectors(p.cos_o);
  V rest = set(1.0f), density = hn::Zero(Floats());
  const std::size_t turn = t.lobes.forward_count, end = t.lobes.ggx.size();
  add_densities(t, 0, turn, p, basis, p.s_xy2, rest, density);
  if (HWY_UNLIKELY(turn < end)) add_densities(t, turn, end, p, basis, p.d_xy2, rest, density);
  const V cosine = hn::Mul(p.cos_i, set(std::numbers::inv_pi_v<float>));
  return hn::IfThenElseZero(p.valid, hn::MulAdd(hn::Max(rest, hn::Zero(Floats())), cosine, density));
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

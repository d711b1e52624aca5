// SPDX-License-Identifier: Apache-2.0
// A vector of directions drawn from the mixture; formulas of eval/warp.h.
#include "eval/tables.h"
#include "eval/warp.h"

#include "eval/eval_kernel-inl.h"

#if defined(BRDF_SAMPLE_WARP_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_WARP_KERNEL_INL_H_
#undef BRDF_SAMPLE_WARP_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_WARP_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {
namespace kernel = brdf::eval::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;
using kernel::Directions;
using kernel::Floats;
using kernel::Ints;
using kernel::set;
using kernel::V;
using kernel::VI;

/// Random numbers into [0, 1).
HWY_INLINE V into_unit_interval(V u) {
  return hn::Min(hn::Max(u, hn::Zero(Floats())), set(eval::largest_below_one));
}

struct Turn {
  V cosine, sine;
};

/// (cos, sin) of 2 pi u.
HWY_INLINE Turn turn(V u) {
  using P = eval::TurnPolynomials;
  const Ints di;
  const V quarters = hn::Mul(u, set(4.0f)), nearest = hn::Floor(hn::Add(quarters, set(0.5f)));
  const V r = hn::Sub(quarters, nearest), r2 = hn::Mul(r, r);
  V s = hn::MulAdd(set(P::s7), r2, set(P::s5)), c = hn::MulAdd(set(P::c8), r2, set(P::c6));
  s = hn::MulAdd(s, r2, set(P::s3));
  c = hn::MulAdd(c, r2, set(P::c4));
  s = hn::Mul(hn::MulAdd(s, r2, set(P::s1)), r);
  c = hn::MulAdd(hn::MulAdd(c, r2, set(P::c2)), r2, set(1.0f));
  const VI quadrant = hn::ConvertTo(di, nearest), one = hn::Set(di, 1);
  const auto odd = hn::RebindMask(Floats(), hn::Eq(hn::And(quadrant, one), one));
  // the sign of the cosine is bit 1 of quadrant + 1, that of the sine is bit 1 of quadrant
  const VI sign = hn::Set(di, static_cast<std::int32_t>(0x80000000u));
  const V flip_c = hn::BitCast(Floats(), hn::And(hn::ShiftLeft<30>(hn::Add(quadrant, one)), sign));
  const V flip_s = hn::BitCast(Floats(), hn::And(hn::ShiftLeft<30>(quadrant), sign));
  return {hn::Xor(hn::IfThenElse(odd, s, c), flip_c), hn::Xor(hn::IfThenElse(odd, c, s), flip_s)};
}

/// The component that each lane draws from: alpha of a GGX lobe and +1 or -1 for its view direction, or cosine.
struct Choice {
  V alpha, side;
  hn::Mask<Floats> cosine;
};

HWY_INLINE Choice choose(const eval::Tables& t, V cos_o, V u) {
  const Floats d;
  const kernel::BernsteinVectors basis = kernel::bernstein_vectors(cos_o);
  Choice c{set(1.0f), set(1.0f), hn::Eq(u, u)};
  V upto = hn::Zero(d);
  for (std::size_t k = 0; k < t.lobes.ggx.size(); ++k) {
    const eval::GgxLobe& g = t.lobes.ggx[k];
    upto = hn::Add(upto, kernel::mixture_weights(t.mixture.lobe[k], basis));
    const auto here = hn::And(hn::Lt(u, upto), c.cosine);
    c.alpha = hn::IfThenElse(here, set(g.alpha), c.alpha);
    c.side = hn::IfThenElse(here, set(g.retro ? -1.0f : 1.0f), c.side);
    c.cosine = hn::AndNot(here, c.cosine);
  }
  return c;
}

/// wi of each lane; z <= 0 where it fell below the horizon.
HWY_INLINE Directions mixture_directions(const eval::Tables& t, const Directions& wo, const Directions& random) {
  const Floats d;
  const V zero = hn::Zero(d), one = set(1.0f);
  const V u = into_unit_interval(random.y), v = into_unit_interval(random.z);
  const Choice c = choose(t, wo.z, into_unit_interval(random.x));
  const Turn phi = turn(v);

  const V x = hn::Mul(wo.x, c.side), y = hn::Mul(wo.y, c.side);
  const V ex = hn::Mul(x, c.alpha), ey = hn::Mul(y, c.alpha);
  const V inv = hn::Div(one, hn::Sqrt(hn::MulAdd(ex, ex, hn::MulAdd(ey, ey, hn::Mul(wo.z, wo.z)))));
  const V z0 = hn::Mul(wo.z, inv);
  const V drop = hn::Mul(u, hn::Add(one, z0));
  // the cosine lobe shares the root: r^2 = u, z^2 = 1 - u
  const V r2 = hn::IfThenElse(c.cosine, u, hn::Max(hn::Mul(drop, hn::Sub(set(2.0f), drop)), zero));
  const V r = hn::Sqrt(r2);
  const V rc = hn::Mul(r, phi.cosine), rs = hn::Mul(r, phi.sine);
  const V hx = hn::Mul(hn::MulAdd(ex, inv, rc), c.alpha), hy = hn::Mul(hn::MulAdd(ey, inv, rs), c.alpha);
  const V hz = hn::Max(hn::Add(hn::Sub(one, drop), z0), zero);
  const V h2 = hn::MulAdd(hx, hx, hn::MulAdd(hy, hy, hn::Mul(hz, hz)));
  const V dot = hn::MulAdd(x, hx, hn::MulAdd(y, hy, hn::Mul(wo.z, hz)));
  const V scale = hn::IfThenElseZero(hn::Gt(h2, zero), hn::Div(hn::Add(dot, dot), h2));
  Directions wi;
  wi.x = hn::IfThenElse(c.cosine, rc, hn::MulSub(scale, hx, x));
  wi.y = hn::IfThenElse(c.cosine, rs, hn::MulSub(scale, hy, y));
  wi.z = hn::IfThenElse(c.cosine, hn::Sqrt(hn::Sub(one, u)), hn::MulSub(scale, hz, wo.z));
  return wi;
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

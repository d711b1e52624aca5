// SPDX-License-Identifier: Apache-2.0
// The map of sample/half_vector_map.h and its inverse, for a vector of views, and the cosine density.
#include "sample/half_vector_map.h"

#include <numbers>

#include "eval/eval_kernel-inl.h"

#if defined(BRDF_SAMPLE_MAP_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_MAP_KERNEL_INL_H_
#undef BRDF_SAMPLE_MAP_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_MAP_KERNEL_INL_H_
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

/// Random numbers into [0, 1), NaN to 0.
HWY_INLINE V into_unit_interval(V u) {
  const V zero = hn::Zero(Floats());
  return hn::Min(hn::IfThenElseZero(hn::Gt(u, zero), u), set(below_one));
}

/// Views as the map wants them: height and the azimuth that v counts from.
struct Views {
  Directions wo;  ///< z at least min_view_cosine
  V s, e_x, e_y;
};

HWY_INLINE Views views_of(const Directions& wo) {
  const V rho2 = hn::MulAdd(wo.x, wo.x, hn::Mul(wo.y, wo.y)), s = kernel::root(rho2), inv = kernel::quotient(set(1.0f), hn::Max(s, set(1e-15f)));
  const auto tilted = hn::Gt(rho2, set(1e-30f));
  Views w;
  w.wo = {wo.x, wo.y, hn::Max(wo.z, set(min_view_cosine))};
  w.s = s;
  w.e_x = hn::IfThenElse(tilted, hn::Mul(wo.x, inv), set(1.0f));
  w.e_y = hn::IfThenElseZero(tilted, hn::Mul(wo.y, inv));
  return w;
}

/// v as the distance w from its nearer end.
struct Azimuth {
  V w;
  hn::Mask<Floats> near;  ///< v <= 1/2: cos phi = 1 - 4 w^2, else 4 w^2 - 1
};

HWY_INLINE V cosine_of(const Azimuth& a) {
  const V cosine = hn::NegMulAdd(hn::Mul(set(4.0f), a.w), a.w, set(1.0f));
  return hn::IfThenElse(a.near, cosine, hn::Neg(cosine));
}

/// 1 - cos theta_max
HWY_INLINE V horizon(const Views& w, V cos_phi) {
  const V zero = hn::Zero(Floats()), half = set(0.5f);
  const V x = hn::Mul(w.s, cos_phi), c2 = hn::Mul(w.wo.z, w.wo.z);
  const V r = kernel::root(hn::MulAdd(x, x, c2)), sum = hn::Add(r, hn::Abs(x)), inv = kernel::quotient(half, hn::Mul(r, sum));
  const V large = hn::Mul(hn::Mul(sum, sum), inv), small = hn::Mul(c2, inv);  // halved
  const auto forward = hn::Ge(x, zero);
  return kernel::quotient(hn::IfThenElse(forward, large, small),
                 hn::Add(set(1.0f), kernel::root(hn::IfThenElse(forward, small, large))));
}

/// Density per solid angle of one that is 1 in the unit square: 1 / (8 (wo . h) horizon dphi/dv), over both sides.
HWY_INLINE V map_density(const Azimuth& a, V wo_h, V top) {
  return kernel::quotient(kernel::root(hn::NegMulAdd(hn::Mul(set(4.0f), a.w), a.w, set(2.0f))),
                 hn::Mul(hn::Mul(set(32.0f), wo_h), top));
}

struct Mapped {
  Directions wi;
  V density;
};

/// The direction of (S, v); `side` is 1 or -1.
HWY_INLINE Mapped mapped_direction(const Views& w, V height, const Azimuth& a, V side) {
  const V zero = hn::Zero(Floats()), two = set(2.0f);
  const V w2 = hn::Mul(a.w, a.w), cos_phi = cosine_of(a);
  const V sin_phi = hn::Mul(hn::Mul(a.w, kernel::root(hn::Max(hn::NegMulAdd(set(16.0f), w2, set(8.0f)), zero))), side);
  const V top = horizon(w, cos_phi), y = hn::Mul(height, top), rho = kernel::root(hn::Mul(y, hn::Sub(two, y)));
  const V h_x = hn::Mul(rho, cos_phi), h_y = hn::Mul(rho, sin_phi), h_z = hn::Sub(set(1.0f), y);
  const V wo_h = hn::MulAdd(w.s, h_x, hn::Mul(w.wo.z, h_z)), twice = hn::Add(wo_h, wo_h);
  const V x = hn::MulSub(h_x, w.e_x, hn::Mul(h_y, w.e_y)), y_ = hn::MulAdd(h_x, w.e_y, hn::Mul(h_y, w.e_x));
  Mapped m;
  m.wi = {hn::MulSub(twice, x, w.wo.x), hn::MulSub(twice, y_, w.wo.y),
          hn::Max(hn::MulSub(twice, h_z, w.wo.z), set(min_drawn_cosine))};
  m.density = map_density(a, wo_h, top);
  return m;
}

struct Point {
  V height, v, density;
};

/// The point of a direction above the horizon.
HWY_INLINE Point mapped_point(const Views& w, const Directions& wi) {
  const V zero = hn::Zero(Floats()), one = set(1.0f), half = set(0.5f), tiny = set(1e-36f);
  const V h_x = hn::Add(wi.x, w.wo.x), h_y = hn::Add(wi.y, w.wo.y), h_z = hn::Add(wi.z, w.wo.z);
  const V along = hn::MulAdd(h_x, w.e_x, hn::Mul(h_y, w.e_y)), across = hn::MulSub(h_y, w.e_x, hn::Mul(h_x, w.e_y));
  const V across2 = hn::Mul(across, across), rho2 = hn::MulAdd(along, along, across2), rho = kernel::root(rho2);
  const V length = kernel::root(hn::MulAdd(h_z, h_z, rho2));
  Azimuth a;
  a.w = hn::Mul(half, kernel::root(hn::Min(kernel::quotient(across2, hn::Max(hn::Mul(rho, hn::Add(rho, hn::Abs(along))), tiny)), one)));
  a.near = hn::Ge(along, zero);
  const V top = horizon(w, cosine_of(a));
  const V y = kernel::quotient(rho2, hn::Mul(hn::Mul(length, hn::Add(length, h_z)), top));
  return {hn::Min(y, one), hn::IfThenElse(a.near, a.w, hn::Sub(one, a.w)), map_density(a, hn::Mul(half, length), top)};
}

HWY_INLINE V cosine_density(V cos_i) { return hn::Mul(cos_i, set(std::numbers::inv_pi_v<float>)); }

/// A cosine-distributed direction: Malley's method on the polar map, u the azimuth. sin and cos of pi/2 r for |r| <= 1/2
/// are polynomials in r^2 through the Chebyshev nodes; error below 3e-9.
HWY_INLINE Directions cosine_directions(V u, V v) {
  const Ints di;
  const V one = set(1.0f);
  const V quarters = hn::Mul(u, set(4.0f)), nearest = hn::Floor(hn::Add(quarters, set(0.5f)));
  const V r = hn::Sub(quarters, nearest), r2 = hn::Mul(r, r);
  V s = hn::MulAdd(set(-0.004602149213f), r2, set(0.07968021765f)), c = hn::MulAdd(set(0.0009067398958f), r2, set(-0.02086152834f));
  s = hn::MulAdd(s, r2, set(-0.6459634777f));
  c = hn::MulAdd(c, r2, set(0.2536694104f));
  s = hn::Mul(hn::MulAdd(s, r2, set(1.570796322f)), r);
  c = hn::MulAdd(hn::MulAdd(c, r2, set(-1.233700549f)), r2, one);
  const VI quadrant = hn::ConvertTo(di, nearest), first = hn::Set(di, 1);
  const auto odd = hn::RebindMask(Floats(), hn::Eq(hn::And(quadrant, first), first));
  // the sign of the cosine is bit 1 of quadrant + 1, that of the sine is bit 1 of quadrant
  const VI sign = hn::Set(di, static_cast<std::int32_t>(0x80000000u));
  const V flip_c = hn::BitCast(Floats(), hn::And(hn::ShiftLeft<30>(hn::Add(quadrant, first)), sign));
  const V flip_s = hn::BitCast(Floats(), hn::And(hn::ShiftLeft<30>(quadrant), sign));
  const V radius = kernel::root(v);
  return {hn::Mul(radius, hn::Xor(hn::IfThenElse(odd, s, c), flip_c)),
          hn::Mul(radius, hn::Xor(hn::IfThenElse(odd, c, s), flip_s)), kernel::root(hn::Sub(one, v))};
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

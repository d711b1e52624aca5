// SPDX-License-Identifier: Apache-2.0
// Quotients, roots and partial vectors for the batch kernels. Compiled once per instruction set.
#include "eval/pair_terms.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#if defined(BRDF_EVAL_VECTOR_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_VECTOR_MATH_INL_H_
#undef BRDF_EVAL_VECTOR_MATH_INL_H_
#else
#define BRDF_EVAL_VECTOR_MATH_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using V = hn::Vec<Floats>;
using VI = hn::Vec<Ints>;

inline constexpr std::size_t max_lanes = HWY_MAX_BYTES / sizeof(float);

HWY_INLINE V set(float x) { return hn::Set(Floats(), x); }

// The estimates of AVX2 (12 bits) and AVX-512 (14 bits) need one Newton step to be as good as a division and free the
// divider, which otherwise bounds the kernels. Elsewhere the estimates have 8 bits, or there is no fused multiply-add to
// keep the step exact, so the hardware's division stays.
#undef BRDF_REFINED_ESTIMATES
#if HWY_ARCH_X86 && HWY_TARGET <= BRDF_EST
#define BRDF_REFINED_ESTIMATES 1
#else
#define BRDF_REFINED_ESTIMATES 0
#endif

/// 1 / x for x in [min_denominator, 1e37].
HWY_INLINE V reciprocal(V x) {
#if BRDF_REFINED_ESTIMATES
  const V y = hn::ApproximateReciprocal(x);
  return hn::MulAdd(y, hn::NegMulAdd(x, y, set(1.0f)), y);
#else
  return hn::Div(set(1.0f), x);
#endif
}

/// sqrt(x) for x in [min_denominator, 1e37].
HWY_INLINE V root(V x) {
#if BRDF_REFINED_ESTIMATES
  const V y = hn::ApproximateReciprocalSqrt(x);
  const V r = hn::Mul(x, y), half_y = hn::Mul(y, set(0.5f));
  return hn::MulAdd(half_y, hn::NegMulAdd(r, r, x), r);
#else
  return hn::Sqrt(x);
#endif
}

/// `count` floats from `p`, the rest of the vector 0.
HWY_INLINE V load_first(const float* HWY_RESTRICT p, std::size_t count) {
  const Floats d;
  if (HWY_LIKELY(count == hn::Lanes(d))) return hn::LoadU(d, p);
  HWY_ALIGN float lanes[max_lanes] = {};
  std::memcpy(lanes, p, count * sizeof(float));
  return hn::Load(d, lanes);
}

HWY_INLINE void store_first(V v, float* HWY_RESTRICT p, std::size_t count) {
  const Floats d;
  if (HWY_LIKELY(count == hn::Lanes(d))) return hn::StoreU(v, d, p);
  HWY_ALIGN float lanes[max_lanes];
  hn::Store(v, d, lanes);
  std::memcpy(p, lanes, count * sizeof(float));
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

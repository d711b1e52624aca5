// SPDX-License-Identifier: Apache-2.0
// Vector types and partial vectors of the batch kernels. Compiled once per instruction set.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#if defined(BRDF_EVAL_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_VECTORS_INL_H_
#undef BRDF_EVAL_VECTORS_INL_H_
#else
#define BRDF_EVAL_VECTORS_INL_H_
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

// Roots and quotients are the hardware's up to AVX2, where they take the fewest instructions and the divider is never
// what a pair waits for. The divider serves 512 bits in twice the time: there an estimate and one Newton step (3 units in
// the last place) measured a fifth faster.
#if HWY_TARGET <= HWY_AVX3
/// sqrt(x) for x from 0 to 1e37
HWY_INLINE V root(V x) {
  const V e = hn::ApproximateReciprocalSqrt(hn::Max(x, set(1.2e-38f))), xe = hn::Mul(x, e);
  return hn::MulAdd(hn::Mul(xe, set(0.5f)), hn::NegMulAdd(xe, e, set(1.0f)), xe);
}

/// a / b for b from 1.2e-38 to 8e37
HWY_INLINE V quotient(V a, V b) {
  const V e = hn::ApproximateReciprocal(b);
  return hn::Mul(a, hn::MulAdd(e, hn::NegMulAdd(b, e, set(1.0f)), e));
}
#else
HWY_INLINE V root(V x) { return hn::Sqrt(x); }
HWY_INLINE V quotient(V a, V b) { return hn::Div(a, b); }
#endif

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

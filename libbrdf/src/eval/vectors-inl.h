// SPDX-License-Identifier: Apache-2.0
// Vector types and partial vectors of the batch kernels. Compiled once per instruction set. Roots and quotients are the
// hardware's: estimates with a Newton step measured no faster on AVX2 and AVX-512, and cost digits and special cases.
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

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

// SPDX-License-Identifier: Apache-2.0
// Vectors of directions, loaded from planes whose size need not be a multiple of a vector's. Compiled once per
// instruction set.
#include <brdf/direction.h>

#include <cstddef>
#include <cstring>

#include <hwy/highway.h>

#if defined(BRDF_PEERS_PARTIAL_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_PEERS_PARTIAL_VECTORS_INL_H_
#undef BRDF_PEERS_PARTIAL_VECTORS_INL_H_
#else
#define BRDF_PEERS_PARTIAL_VECTORS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::peers::HWY_NAMESPACE {
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

struct Directions {
  V x, y, z;
};

HWY_INLINE Directions load_directions(const DirectionSpan& w, std::size_t at, std::size_t count) {
  return {load_first(w.x + at, count), load_first(w.y + at, count), load_first(w.z + at, count)};
}

}  // namespace brdf::peers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

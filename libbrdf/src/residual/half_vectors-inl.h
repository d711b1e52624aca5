// SPDX-License-Identifier: Apache-2.0
// Vectors of floats to half floats, as residual/half_float.h converts one; without an instruction for it, so that every
// instruction set gives the same bits.
#include <cstdint>

#include <hwy/highway.h>

#if defined(BRDF_RESIDUAL_HALF_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_RESIDUAL_HALF_VECTORS_INL_H_
#undef BRDF_RESIDUAL_HALF_VECTORS_INL_H_
#else
#define BRDF_RESIDUAL_HALF_VECTORS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::residual::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;

/// Halves nearest to normal positive numbers, ties to even.
HWY_INLINE void store_halves(V x, std::uint16_t* HWY_RESTRICT out) {
  const hn::RebindToUnsigned<Floats> bits_of;
  const hn::Rebind<std::uint16_t, Floats> halves;
  const auto bits = hn::BitCast(bits_of, x);
  const auto odd = hn::And(hn::ShiftRight<13>(bits), hn::Set(bits_of, 1));
  const auto rounded = hn::ShiftRight<13>(hn::Add(hn::Add(bits, hn::Set(bits_of, 0xFFF)), odd));
  const auto half = hn::Sub(rounded, hn::Set(bits_of, 112U << 10));
  hn::StoreU(hn::DemoteTo(halves, hn::BitCast(hn::RebindToSigned<Floats>(), half)), halves, out);
}

}  // namespace brdf::residual::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

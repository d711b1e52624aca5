// SPDX-License-Identifier: Apache-2.0
// A row times a number, added to another: no fused operation, so that every instruction set gives the same bits.
#include <cstddef>

#include <hwy/highway.h>

#if defined(BRDF_RESIDUAL_ADD_SCALED_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_RESIDUAL_ADD_SCALED_INL_H_
#undef BRDF_RESIDUAL_ADD_SCALED_INL_H_
#else
#define BRDF_RESIDUAL_ADD_SCALED_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::residual::HWY_NAMESPACE {

/// out[i] += a in[i] for n floats
HWY_INLINE void add_scaled(float a, const float* HWY_RESTRICT in, float* HWY_RESTRICT out, std::size_t n) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const auto scale = hn::Set(d, a);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= n; i += hn::Lanes(d))
    hn::StoreU(hn::Add(hn::LoadU(d, out + i), hn::Mul(scale, hn::LoadU(d, in + i))), d, out + i);
  for (; i < n; ++i) out[i] += a * in[i];
}

}  // namespace brdf::residual::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

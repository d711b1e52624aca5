// SPDX-License-Identifier: Apache-2.0
// Eight floats along one row of a residual grid: a 256-bit vector where there is one, else a vector of the compiler.
#include "residual/half_float.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#if defined(BRDF_EVAL_EIGHT_FLOATS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_EVAL_EIGHT_FLOATS_INL_H_
#undef BRDF_EVAL_EIGHT_FLOATS_INL_H_
#else
#define BRDF_EVAL_EIGHT_FLOATS_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
using Eight = hn::FixedTag<float, 8>;
struct EightFloats {
  hn::Vec<Eight> v;
};

/// p[i] + offset
HWY_INLINE EightFloats load_eight(const float* p, float offset) {
  return {hn::Add(hn::LoadU(Eight(), p), hn::Set(Eight(), offset))};
}

HWY_INLINE void store_eight(const EightFloats& a, float* HWY_RESTRICT p) { hn::StoreU(a.v, Eight(), p); }

HWY_INLINE EightFloats subtract(const EightFloats& a, const EightFloats& b) { return {hn::Sub(a.v, b.v)}; }

/// a + scale b
HWY_INLINE EightFloats add_scaled(const EightFloats& a, float scale, const EightFloats& b) {
  return {hn::MulAdd(hn::Set(Eight(), scale), b.v, a.v)};
}

/// weight p[i]
HWY_INLINE EightFloats weighted_eight(float weight, const float* p) {
  return {hn::Mul(hn::Set(Eight(), weight), hn::LoadU(Eight(), p))};
}

/// sum + weight p[i]
HWY_INLINE EightFloats add_weighted_eight(const EightFloats& sum, float weight, const float* p) {
  return {hn::MulAdd(hn::Set(Eight(), weight), hn::LoadU(Eight(), p), sum.v)};
}

/// Number of lanes that are not above x.
HWY_INLINE std::size_t count_up_to(const EightFloats& a, float x) {
  return hn::CountTrue(Eight(), hn::Le(a.v, hn::Set(Eight(), x)));
}

/// The same of lanes 0, 2 and 4; the others must not be negative.
HWY_INLINE std::size_t count_even_up_to(const EightFloats& a, float x) {
  HWY_ALIGN static constexpr float out[8] = {0, 2e30f, 0, 2e30f, 0, 2e30f, 2e30f, 2e30f};
  return hn::CountTrue(Eight(), hn::Le(a.v, hn::Sub(hn::Set(Eight(), x), hn::Load(Eight(), out))));
}

/// max(0, (lobes + epsilon) ratio - epsilon)
HWY_INLINE EightFloats with_ratio(const EightFloats& lobes, const EightFloats& ratio, float epsilon) {
  const auto e = hn::Set(Eight(), epsilon);
  return {hn::Max(hn::MulSub(hn::Add(lobes.v, e), ratio.v, e), hn::Zero(Eight()))};
}

/// What weights must hold so that a sum of weighted halves comes out right: conversion is an instruction here.
inline constexpr float row_scale = 1.0f;

HWY_INLINE hn::Vec<Eight> eight_halves(const std::uint16_t* p) {
  const hn::FixedTag<std::uint16_t, 8> bits;
  return hn::PromoteTo(Eight(), hn::BitCast(hn::FixedTag<hwy::float16_t, 8>(), hn::LoadU(bits, p)));
}

/// Sum of weight[k stride] times the eight halves at row[k] + offset
HWY_INLINE EightFloats weighted_rows(const std::uint16_t* const row[4], std::ptrdiff_t offset, const float* weight,
                                     std::size_t stride) {
  const Eight d;
  auto sum = hn::Mul(hn::Set(d, weight[0]), eight_halves(row[0] + offset));
  sum = hn::MulAdd(hn::Set(d, weight[stride]), eight_halves(row[1] + offset), sum);
  sum = hn::MulAdd(hn::Set(d, weight[2 * stride]), eight_halves(row[2] + offset), sum);
  return {hn::MulAdd(hn::Set(d, weight[3 * stride]), eight_halves(row[3] + offset), sum)};
}

/// out[c] = a[c] + fraction (a[c + 3] - a[c]) for c < 3; writes four floats.
HWY_INLINE void lerp_rgb(const EightFloats& a, float fraction, float* HWY_RESTRICT out) {
  HWY_ALIGN static constexpr std::int32_t next[8] = {3, 4, 5, 5, 5, 5, 5, 5};
  const hn::FixedTag<float, 4> four;
  const auto below = hn::LowerHalf(four, a.v);
  const auto above = hn::LowerHalf(four, hn::TableLookupLanes(a.v, hn::SetTableIndices(Eight(), next)));
  hn::StoreU(hn::MulAdd(hn::Set(four, fraction), hn::Sub(above, below), below), four, out);
}
#else
// The vectors of the compiler (gcc, clang), which it splits into those of the processor.
typedef float Float8 __attribute__((vector_size(32)));
typedef std::uint16_t Half8 __attribute__((vector_size(16)));
typedef std::uint32_t Bits8 __attribute__((vector_size(32)));
struct EightFloats {
  Float8 v;
};

HWY_INLINE EightFloats load_eight(const float* p, float offset) {
  EightFloats a;
  std::memcpy(&a.v, p, sizeof a.v);
  a.v += offset;
  return a;
}

HWY_INLINE void store_eight(const EightFloats& a, float* HWY_RESTRICT p) { std::memcpy(p, &a.v, sizeof a.v); }

HWY_INLINE EightFloats subtract(const EightFloats& a, const EightFloats& b) { return {a.v - b.v}; }

HWY_INLINE EightFloats add_scaled(const EightFloats& a, float scale, const EightFloats& b) {
  return {a.v + scale * b.v};
}

HWY_INLINE EightFloats weighted_eight(float weight, const float* p) {
  EightFloats a;
  std::memcpy(&a.v, p, sizeof a.v);
  a.v *= weight;
  return a;
}

HWY_INLINE EightFloats add_weighted_eight(const EightFloats& sum, float weight, const float* p) {
  return {sum.v + weighted_eight(weight, p).v};
}

HWY_INLINE std::size_t count_up_to(const EightFloats& a, float x) {
  const auto at_most = a.v <= x;  // -1 where true
  int count = 0;
  for (int i = 0; i < 8; ++i) count -= at_most[i];
  return static_cast<std::size_t>(count);
}

HWY_INLINE std::size_t count_even_up_to(const EightFloats& a, float x) {
  return static_cast<std::size_t>((a.v[0] <= x) + (a.v[2] <= x) + (a.v[4] <= x));
}

HWY_INLINE EightFloats with_ratio(const EightFloats& lobes, const EightFloats& ratio, float epsilon) {
  const Float8 f = (lobes.v + epsilon) * ratio.v - epsilon;
  return {f > 0.0f ? f : Float8{}};
}

// Halves moved to the place of floats are 2^-112 times their value.
inline constexpr float row_scale = residual::half_exponent_scale;

HWY_INLINE EightFloats weighted_rows(const std::uint16_t* const row[4], std::ptrdiff_t offset, const float* weight,
                                     std::size_t stride) {
  EightFloats sum = {};
  for (std::size_t k = 0; k < 4; ++k) {
    Half8 halves;
    std::memcpy(&halves, row[k] + offset, sizeof halves);
    const Bits8 bits = __builtin_convertvector(halves, Bits8) << 13;
    Float8 shifted;
    std::memcpy(&shifted, &bits, sizeof shifted);
    sum.v += weight[k * stride] * shifted;
  }
  return sum;
}

HWY_INLINE void lerp_rgb(const EightFloats& a, float fraction, float* HWY_RESTRICT out) {
  float v[8];
  std::memcpy(v, &a.v, sizeof v);
  for (int c = 0; c < 3; ++c) out[c] = v[c] + fraction * (v[c + 3] - v[c]);
  out[3] = 0;
}
#endif

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

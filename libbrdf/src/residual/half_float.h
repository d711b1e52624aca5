// SPDX-License-Identifier: Apache-2.0
// IEEE 754 binary16 for ratios: positive normal values only, which decode with one shift and one multiplication.
#pragma once

#include <bit>
#include <cstdint>

namespace brdf::residual {

inline constexpr std::uint16_t half_min_normal = 0x0400;  ///< 2^-14
inline constexpr std::uint16_t half_max = 0x7bff;         ///< 65504
inline constexpr float half_min_normal_value = 6.103515625e-05f;
inline constexpr float half_max_value = 65504.0f;

/// A binary16 pattern moved to the place of a binary32 one reads 2^-112 times the value; this undoes it.
inline constexpr float half_exponent_scale = 5.192296858534828e+33f;  // 2^112

/// Whether `h` is positive and normal.
constexpr bool is_positive_normal_half(std::uint16_t h) noexcept { return h >= half_min_normal && h <= half_max; }

/// Nearest binary16, ties to even; clamped to the positive normal range. NaN gives the smallest value.
constexpr std::uint16_t half_from_float(float x) noexcept {
  if (!(x > half_min_normal_value)) return half_min_normal;
  if (x >= half_max_value) return half_max;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t odd = (bits >> 13) & 1u;
  const std::uint32_t rounded = (bits + 0xfffu + odd) >> 13;  // a carry out of the mantissa raises the exponent: wanted
  const std::uint32_t half = rounded - (112u << 10);
  return half > half_max ? half_max : static_cast<std::uint16_t>(half);
}

/// Value of a positive normal binary16.
constexpr float float_from_half(std::uint16_t h) noexcept {
  return std::bit_cast<float>((static_cast<std::uint32_t>(h) & 0x7fffu) << 13) * half_exponent_scale;
}

}  // namespace brdf::residual

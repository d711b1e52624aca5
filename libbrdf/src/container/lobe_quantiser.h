// SPDX-License-Identifier: Apache-2.0
// Lobe parameters as whole numbers: logarithmic codes of 11 bits, amplitudes below a common exponent.
#pragma once

#include <brdf/error.h>
#include <brdf/lobes.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace brdf::container {

inline constexpr int lobe_code_bits = 11, lobe_count_bits = 4, exponent_bits = 8, exponent_offset = 128;
inline constexpr std::int32_t largest_lobe_code = (1 << lobe_code_bits) - 1;
inline constexpr int largest_exponent = 99;               // 6e29: products of lobes and ratios stay finite floats
inline constexpr double alpha_octaves = 16.6096404744368;  // log2(1 / 1e-5)

/// Lambert has a colour alone; the others have alpha and f90 too.
inline bool has_microfacets(LobeKind kind) noexcept { return kind != LobeKind::lambert; }

inline double amplitude_of(std::int32_t code, int exponent) noexcept {
  return code == 0 ? 0.0 : std::exp2(exponent - (largest_lobe_code - code) / 128.0);
}

inline std::int32_t amplitude_code(double value, int exponent) noexcept {
  if (!(value > 0)) return 0;
  const double code = std::round(largest_lobe_code + (std::log2(value) - exponent) * 128.0);
  return code < 1 ? 0 : static_cast<std::int32_t>(std::min(code, static_cast<double>(largest_lobe_code)));
}

inline double alpha_of(std::int32_t code) noexcept { return std::exp2(-code / static_cast<double>(largest_lobe_code) * alpha_octaves); }

inline std::int32_t alpha_code(double alpha) noexcept {
  const double octaves = std::clamp(-std::log2(alpha), 0.0, alpha_octaves);
  return static_cast<std::int32_t>(std::lround(octaves / alpha_octaves * largest_lobe_code));
}

/// Throws Error(limit_exceeded).
inline void check_lobe_count(std::uint32_t count, std::uint32_t max_lobes) {
  if (count > max_lobes)
    throw Error(ErrorCode::limit_exceeded, "lobes: " + std::to_string(count) + " are stored, the limit is " + std::to_string(max_lobes));
}

/// The stored exponent without its offset. Throws Error(malformed).
inline int exponent_of(std::uint32_t stored) {
  const int exponent = static_cast<int>(stored) - exponent_offset;
  if (exponent > largest_exponent)
    throw Error(ErrorCode::malformed, "lobes: amplitudes up to 2^" + std::to_string(exponent) + " are declared, at most 2^" +
                                          std::to_string(largest_exponent) + " are allowed");
  return exponent;
}

}  // namespace brdf::container

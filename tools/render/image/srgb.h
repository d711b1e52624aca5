// SPDX-License-Identifier: Apache-2.0
// The transfer function of sRGB, IEC 61966-2-1:1999, both ways.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace brdf::render {

/// Linear [0, 1] to encoded [0, 1].
inline double srgb_encode(double linear) noexcept {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Encoded [0, 1] to linear [0, 1].
inline double srgb_decode(double encoded) noexcept {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Linear to the nearest of the 256 codes; what is outside [0, 1] is clipped, NaN is 0.
inline std::uint8_t srgb_code(double linear) noexcept {
  if (!(linear > 0)) return 0;
  return static_cast<std::uint8_t>(std::lround(255 * srgb_encode(std::min(linear, 1.0))));
}

}  // namespace brdf::render

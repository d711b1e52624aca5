// SPDX-License-Identifier: Apache-2.0
// Recorded errors as one byte each, rounded to the pessimistic side.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace brdf::container {

/// 0 = exactly 0, else 2^((code - 240) / 8).
inline double log_mae_of(std::uint8_t code) noexcept { return code == 0 ? 0.0 : std::exp2((code - 240) / 8.0); }
inline std::uint8_t log_mae_code(double v) noexcept {
  if (v != v) return 255;  // unknown counts as bad
  if (!(v > 0)) return 0;
  return static_cast<std::uint8_t>(std::clamp(std::ceil(std::log2(v) * 8.0 + 240.0), 1.0, 255.0));
}

/// Quarter decibels, 0 to 63.75.
inline double psnr_of(std::uint8_t code) noexcept { return code / 4.0; }
inline std::uint8_t psnr_code(double db) noexcept {
  if (db != db) return 0;
  return static_cast<std::uint8_t>(std::clamp(std::floor(db * 4.0), 0.0, 255.0));
}

}  // namespace brdf::container

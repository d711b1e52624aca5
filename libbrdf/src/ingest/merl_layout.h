// SPDX-License-Identifier: Apache-2.0
// The MERL file layout (Matusik et al. 2003): three int32 bin counts (theta_h, theta_d, phi_d), then one plane of
// float64 per channel in the order red, green, blue.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace brdf::ingest {

struct MerlLayout {
  static constexpr std::uint64_t header_bytes = 12;
  static constexpr int channels = 3;
  /// f in 1/sr = raw value times this.
  static constexpr std::array<double, 3> scale = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  static constexpr double invalid = -1;
  static constexpr std::uint64_t cells_half_circle = 90 * 90 * 180;  ///< phi_d over pi
  static constexpr std::uint64_t cells_full_circle = 90 * 90 * 360;  ///< phi_d over 2 pi, not reciprocal

  static constexpr std::uint64_t file_bytes(std::uint64_t cells) noexcept {
    return header_bytes + cells * channels * 8;
  }

  /// Whether bin counts are those of a MERL table: the product of one, 180 or 360 bins of phi_d, at least 2 of the
  /// others.
  static constexpr bool dimensions_fit(const std::array<std::int32_t, 3>& n) noexcept {
    if (n[0] < 2 || n[1] < 2 || n[0] > 16384 || n[1] > 16384 || (n[2] != 180 && n[2] != 360)) return false;
    const std::uint64_t cells =
        static_cast<std::uint64_t>(n[0]) * static_cast<std::uint64_t>(n[1]) * static_cast<std::uint64_t>(n[2]);
    return cells == cells_half_circle || cells == cells_full_circle;
  }
};

}  // namespace brdf::ingest

// SPDX-License-Identifier: Apache-2.0
// The table that directions are drawn from, as numbers of a file.
#pragma once

#include <brdf/material.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brdf::container {

/// Nodes of one component: views, azimuths, heights; the last index runs fastest.
inline constexpr std::size_t density_views = 24, density_rows = 25, density_heights = 33;
inline constexpr std::size_t density_nodes = density_views * density_rows * density_heights;
/// A density is 2^(code / 16).
inline constexpr double density_steps = 16;
inline constexpr std::int32_t largest_density_code = 1600;
inline constexpr std::size_t most_density_bytes = 1 << 18;

struct DensityCodes {
  EvalLevel level = EvalLevel::balanced;               ///< that it was made for
  std::vector<std::vector<std::int16_t>> components;  ///< one, or two for a material with retro lobes: the second are those
  std::array<std::uint8_t, density_views> second{};   ///< share of the second component at each view, of 255
};

std::vector<std::byte> write_density(const DensityCodes& codes);

/// Level, number of components and shares. `retro`: whether the file has retro lobes. Throws Error(malformed).
void check_density(std::span<const std::byte> payload, bool retro);

/// Of a payload that was checked. Any stream makes a density: codes beyond the largest are clamped.
DensityCodes read_density(std::span<const std::byte> payload);

}  // namespace brdf::container

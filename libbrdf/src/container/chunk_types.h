// SPDX-License-Identifier: Apache-2.0
// Identifiers of the file format. docs/format.md describes every field.
#pragma once

#include <cstdint>

namespace brdf::container {

inline constexpr std::uint8_t format_version = 1;

/// Directory entry: bit 7 = optional (may be skipped), bits 6..4 = component, bits 3..0 = type.
/// The whole code counts: an optional chunk of a later version may reuse the number of a critical one.
enum class ChunkType : std::uint8_t { packed_lobes = 0x01, residual = 0x02, refinement = 0x03, lobes = 0x04, analytic = 0x05, provenance = 0x89, sampling = 0x8A };
inline constexpr std::uint8_t optional_bit = 0x80;

/// What the axes of a component's table are.
enum class AxesKind : std::uint8_t { half_difference = 0, slices = 1 };
inline constexpr unsigned axes_kind_count = 2;

inline constexpr int checksum_bytes = 4;

}  // namespace brdf::container

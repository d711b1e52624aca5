// SPDX-License-Identifier: Apache-2.0
/// @file limits.h
/// Bounds that are checked before anything is allocated. Files from outside are hostile.
#pragma once

#include <cstddef>
#include <cstdint>

namespace brdf {

/// Limits for reading other people's measured files.
struct IngestLimits {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 30;     ///< refuse larger files unread
  std::uint64_t max_table_values = std::uint64_t{1} << 28;   ///< cells times channels of one table
  /// All tables of a file together, with the copies that reading them takes; the file itself is not counted.
  std::uint64_t max_temporary_bytes = std::uint64_t{1} << 32;
  std::uint32_t max_fields = 256;                            ///< fields of a tensor file
  std::uint32_t max_channels = 1024;
};

/// Limits for decoding `.brdfc` files.
struct DecodeLimits {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 26;
  std::uint64_t max_table_bytes = std::uint64_t{1} << 27;    ///< tables that prepare() may build
  /// What decoding takes beside its tables: coefficients, which a material keeps for prepare(), and sums on the way to a table.
  std::uint64_t max_temporary_bytes = std::uint64_t{1} << 29;
  std::uint32_t max_channels = 1024;
  std::uint32_t max_lobes = 16;
  std::uint32_t max_refinements = 64;
};

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
/// @file check.h
/// Says of a `.brdfc` file whether it can be read, and at which cost, before anything large is allocated.
#pragma once

#include <brdf/error.h>
#include <brdf/limits.h>
#include <brdf/material.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace brdf {

/// What the tables of one evaluation level cost.
struct LevelCheck {
  std::uint64_t table_bytes = 0;      ///< that stay as long as the material
  std::uint64_t temporary_bytes = 0;  ///< beside them, at most, while the file is read and they are built
  std::optional<Error> problem;       ///< what Material::decode or prepare throws at this level, and nothing if it succeeds
};

/// What check_file found.
struct FileCheck {
  std::optional<Error> problem;  ///< the first; with one, no level can be read and what follows is 0
  std::uint64_t bytes = 0;       ///< given
  std::uint64_t total_bytes = 0; ///< of the whole file
  int refinements_read = 0, refinements_total = 0;  ///< "k of n", lobes not counted
  int channels = 0, lobes = 0;
  std::array<LevelCheck, 3> levels;  ///< see at()
  std::uint64_t sampling_bytes = 0;  ///< of the sampling tables, at any level

  const LevelCheck& at(EvalLevel level) const noexcept { return levels[static_cast<std::size_t>(level)]; }
  /// Whether Material::decode succeeds at a level.
  bool readable(EvalLevel level) const noexcept { return !problem && !at(level).problem; }
};

/// Reads everything that Material::decode reads - header, directory, checksums, lobes, slices, every layer - and works
/// out what the tables of each level would need, without building them. With `allow_prefix`, like DecodeOptions, also a
/// file cut at a boundary. What is wrong with the file is in the result; thrown is only std::bad_alloc.
///
/// Memory: `max_temporary_bytes` at most. Thread-safe.
FileCheck check_file(std::span<const std::byte> bytes, const DecodeLimits& limits = {}, bool allow_prefix = false);

}  // namespace brdf

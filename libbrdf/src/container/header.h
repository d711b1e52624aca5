// SPDX-License-Identifier: Apache-2.0
// Header: magic, version, flags, total length, component declarations, chunk directory, checksum.
#pragma once

#include "container/content.h"

#include <cstdint>
#include <span>
#include <vector>

namespace brdf::container {

struct DirectoryEntry {
  std::uint8_t code = 0;     ///< see ChunkType
  std::uint64_t length = 0;  ///< payload bytes, checksum not counted
};

struct Header {
  Component component;
  std::vector<DirectoryEntry> directory;
  std::uint64_t total_bytes = 0;
  std::size_t header_bytes = 0;  ///< checksum included
  std::uint32_t checksum = 0;    ///< seed of the chain
};

/// Checksum of one link: XXH32 of the bytes, seeded with the link before it.
std::uint32_t chain(std::span<const std::byte> bytes, std::uint32_t before) noexcept;

std::vector<std::byte> write_header(const Component& component, const std::vector<DirectoryEntry>& directory);
Header read_header(std::span<const std::byte> bytes, const DecodeLimits& limits);

}  // namespace brdf::container

// SPDX-License-Identifier: Apache-2.0
#pragma once

// The whole of it inline: no run-time library to link.
#ifndef XXH_INLINE_ALL
#define XXH_INLINE_ALL
#endif
#include <xxhash.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace brdf::base {

/// XXH3-64 with seed 0: fast and stable over versions and machines, no protection against forgery.
inline std::uint64_t xxh3_64(std::span<const std::byte> bytes) noexcept {
  return XXH3_64bits(bytes.data(), bytes.size());
}

/// XXH32: tells damage, as the checksum of files.
inline std::uint32_t xxh32(std::span<const std::byte> bytes, std::uint32_t seed = 0) noexcept {
  return XXH32(bytes.data(), bytes.size(), seed);
}

}  // namespace brdf::base

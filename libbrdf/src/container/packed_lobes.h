// SPDX-License-Identifier: Apache-2.0
// Lobe parameters as plain bits, in files written before they were range coded.
#pragma once

#include <brdf/lobes.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace brdf::container {

/// Throws Error(malformed), Error(unsupported) for an unknown kind, Error(limit_exceeded).
LobeSet read_packed_lobes(std::span<const std::byte> bytes, int channels, std::uint32_t max_lobes);

}  // namespace brdf::container

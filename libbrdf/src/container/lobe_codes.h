// SPDX-License-Identifier: Apache-2.0
// Lobe parameters in a stream of the range coder, with adaptive contexts.
#pragma once

#include <brdf/lobes.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brdf::container {

/// Logarithmic codes: alpha to 0.3 %, amplitudes to 0.3 % over 16 octaves. A channel is coded as its step from the one
/// before, in widths whose probabilities adapt: colours of many wavelengths cost a few bits each.
std::vector<std::byte> write_lobes(const LobeSet& set);

/// Throws Error(malformed), Error(limit_exceeded).
LobeSet read_lobes(std::span<const std::byte> bytes, int channels, std::uint32_t max_lobes);

/// What a decoder will hold: read(write(lobes)).
LobeSet quantise_lobes(const LobeSet& lobes);

}  // namespace brdf::container

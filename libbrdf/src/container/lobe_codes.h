// SPDX-License-Identifier: Apache-2.0
// Lobe parameters as bits.
#pragma once

#include "container/bit_stream.h"

#include <brdf/lobes.h>

namespace brdf::container {

/// Writes the count (4 bits), a common exponent (8 bits) and the lobes: kind (3), alpha and f90 (11 each, GGX kinds
/// only), one colour of 11 bits per channel. Logarithmic codes: alpha to 0.3 %, amplitudes to 0.3 % over 16 octaves.
void write_lobes(BitWriter& out, const LobeSet& lobes);

/// Throws Error(malformed), Error(unsupported) for an unknown kind, Error(limit_exceeded).
LobeSet read_lobes(BitReader& in, int channels, std::uint32_t max_lobes);

/// What a decoder will hold: read(write(lobes)).
LobeSet quantise_lobes(const LobeSet& lobes);

}  // namespace brdf::container

// SPDX-License-Identifier: Apache-2.0
// Where the solver starts.
#pragma once

#include "fit/prepared_samples.h"

#include <brdf/lobes.h>

#include <cstddef>

namespace brdf::fit {

/// Lambert lobe of the mean logarithm. Values of unit scale, like all lobes here.
Lobe starting_lambert(const PreparedSamples& samples);

/// A GGX or retro lobe for what `present` leaves over, looking at the first `count` samples. Start 0 takes the width
/// that the rest shows, the others scan narrower and wider ones.
Lobe starting_ggx(const PreparedSamples& samples, std::size_t count, const LobeSet& present, LobeKind kind, int start);

}  // namespace brdf::fit

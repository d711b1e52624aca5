// SPDX-License-Identifier: Apache-2.0
// Colours of every channel for lobes whose shapes are known.
#pragma once

#include "fit/prepared_samples.h"
#include "fit/sample_set.h"

#include <brdf/lobes.h>

#include <functional>

namespace brdf::fit {

/// Takes lobes of unit scale with the channel groups of `prepared` and gives them the colours of all channels of `set`,
/// each channel fitted on its own under the same loss: linear in the number of channels. `keep_going` as in solve,
/// asked once per channel with whether it runs on the calling thread.
LobeSet fit_channel_colors(const SampleSet& set, const PreparedSamples& prepared, const LobeSet& lobes, int threads,
                           const std::function<bool(bool on_caller)>& keep_going);

/// Sets colours and f90 to 0 that stay far below the offset of the loss wherever there is a sample: the solver moves
/// their logarithms and cannot reach 0 itself.
void clear_invisible_colors(const PreparedSamples& prepared, LobeSet& lobes);

}  // namespace brdf::fit

// SPDX-License-Identifier: Apache-2.0
// Which transform across channels leaves a material the fewest bits.
#pragma once

#include "residual/channel_transform.h"

#include <brdf/lobes.h>
#include <brdf/measurement.h>

namespace brdf::encode {

/// The one with the largest coding gain on the residual: with a given quantiser step, bits per coefficient are half the sum of
/// log2 of the channels' energies (Gersho and Gray 1992, section 8.4). The usual one unless another is better by a few percent.
residual::ChannelTransform decorrelating_transform(const Measurement& m, const LobeSet& lobes, double epsilon);

}  // namespace brdf::encode

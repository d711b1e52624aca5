// SPDX-License-Identifier: Apache-2.0
// The network for batches, on the best instruction set of the machine.
#pragma once

#include "neural_brdf.h"

namespace brdf::peers {

/// `weights` has NeuralBrdf::weight_count entries.
void network_batch(const float* weights, Azimuth azimuth, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept;

}  // namespace brdf::peers

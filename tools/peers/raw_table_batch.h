// SPDX-License-Identifier: Apache-2.0
// Trilinear look-up for batches, on the best instruction set of the machine.
#pragma once

#include "raw_table.h"

namespace brdf::peers {

void look_up_batch(const RawTableView& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept;

}  // namespace brdf::peers

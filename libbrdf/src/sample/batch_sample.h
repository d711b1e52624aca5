// SPDX-License-Identifier: Apache-2.0
// Batches of samples; the instruction set is chosen at run time.
#pragma once

#include "eval/tables.h"

#include <brdf/direction.h>

namespace brdf::sample {

/// See Material::sample. Rejected rows are all zero.
void sample_batch(const eval::Tables& t, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf,
                  PlanarSpan weight) noexcept;

}  // namespace brdf::sample

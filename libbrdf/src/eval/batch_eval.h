// SPDX-License-Identifier: Apache-2.0
// Batches over structure-of-arrays spans; the instruction set is chosen at run time.
#pragma once

#include "eval/tables.h"

#include <brdf/direction.h>

namespace brdf::eval {

void eval_batch(const Tables& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept;

}  // namespace brdf::eval

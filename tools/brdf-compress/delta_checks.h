// SPDX-License-Identifier: Apache-2.0
// What `verify` holds against materials of delta lobes: they have no density, so what is drawn is checked by itself.
#pragma once

#include <brdf/material.h>

#include "check.h"

namespace brdf::cli {

/// Directions by the laws of reflection and refraction, choices by their probability, weights by energy, for views on
/// every side that scatters.
Checks delta_checks(const Material& material);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Bases worth trying for a material: the axes and windows follow the width of its lobes.
#pragma once

#include "residual/residual_code.h"

#include <brdf/lobes.h>
#include <brdf/measurement.h>

#include <vector>

namespace brdf::encode {

/// Offset of the logarithm: small against what a display can show of this material.
double residual_epsilon(const Measurement& m);

/// Up to `count` bases, the most likely first.
std::vector<residual::BasisCodes> basis_variants(const LobeSet& lobes, double epsilon, int count);

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
// Do sample, pdf and eval of a material agree with each other?
#pragma once

#include "check.h"

#include <brdf/material.h>

namespace brdf::cli {

/// For wo from the normal to 89.9 degrees, the worst of each: the integral of pdf, drawn directions against pdf
/// (chi-squared), pdf and weight of the samples against pdf and eval, the mean weight against the quadrature of
/// f cos theta_i; and the largest weight.
Checks sampling_checks(const Material& material);

}  // namespace brdf::cli

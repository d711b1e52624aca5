// SPDX-License-Identifier: Apache-2.0
// Do sample, pdf and eval of a material agree with each other?
#pragma once

#include "check.h"

#include <brdf/material.h>

namespace brdf::cli {

/// For several wo: the integral of pdf, drawn directions against pdf (chi-squared), and pdf and weight of the samples
/// against pdf and eval.
Checks sampling_checks(const Material& material);

}  // namespace brdf::cli

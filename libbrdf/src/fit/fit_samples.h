// SPDX-License-Identifier: Apache-2.0
// The fit behind fit_lobes, for samples from anywhere.
#pragma once

#include "fit/sample_set.h"

#include <brdf/fit.h>
#include <brdf/progress.h>

namespace brdf::fit {

/// As brdf::fit_lobes. `options.samples` is not used: all of `set` is.
FitResult fit_samples(const SampleSet& set, const FitOptions& options, const Progress& progress);

/// Throws Error(invalid_argument) with the sentence of FitOptions::is_valid.
void require_valid(const FitOptions& options);

}  // namespace brdf::fit

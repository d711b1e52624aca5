// SPDX-License-Identifier: Apache-2.0
// The errors that a file records against those measured now.
#pragma once

#include "check.h"
#include "material_source.h"
#include "progress_bar.h"

namespace brdf::cli {

/// For each recorded error: the file must not claim to be better than it is against `reference`.
Checks recorded_checks(const MaterialSource& file, const MaterialSource& reference, int threads, ProgressBar& bar);

}  // namespace brdf::cli

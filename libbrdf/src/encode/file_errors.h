// SPDX-License-Identifier: Apache-2.0
// The errors that a file states about itself, measured refinement by refinement.
#pragma once

#include "encode/candidate.h"
#include "encode/verification.h"

#include <functional>

namespace brdf::encode {

/// What a search lowered; larger is better.
using Worth = std::function<double(const ErrorReport&)>;

/// Measures every refinement at its levels and writes the figures into the content. A refinement that does not improve on
/// what comes before, by `worth` at `level`, is merged into the next one; the last one is left out. Packs the file anew.
void record_errors(Encoded& e, const Verification& verification, EvalLevel level, const Worth& worth);

}  // namespace brdf::encode

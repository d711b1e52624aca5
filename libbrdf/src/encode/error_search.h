// SPDX-License-Identifier: Apache-2.0
// Smallest file whose measured error meets a target.
#pragma once

#include "encode/candidate.h"
#include "encode/verification.h"

#include <brdf/metrics.h>

namespace brdf::encode {

/// Searches the quantiser's step; every step tried is decoded and measured at `level`. Throws Error(target_not_met) with
/// the best value that was reached.
Encoded encode_to_error(const Measurement& m, const container::Content& frame, const residual::BasisCodes& basis,
                        bool reciprocal, const EffortStep& effort, const metrics::QuerySet& queries, const ErrorTarget& target,
                        EvalLevel level, const Verification& verification);

}  // namespace brdf::encode

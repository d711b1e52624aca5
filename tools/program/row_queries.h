// SPDX-License-Identifier: Apache-2.0
// The loop of `eval` and `pdf`: rows of two directions in, rows of answers out.
#pragma once

#include "row_format.h"

#include <brdf/metrics.h>

namespace brdf::cli {

/// Reads rows wi.xyz wo.xyz on stdin and writes `channels` numbers for each to stdout. Directions whose length is off by
/// more than 1e-3 are scaled to unit length; one of length 0 is answered with 0. Memory does not grow with the input.
void answer_rows(const BatchEval& answer, int channels, RowFormat format);

}  // namespace brdf::cli

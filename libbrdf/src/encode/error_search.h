// SPDX-License-Identifier: Apache-2.0
// The smallest file whose measured error meets a target.
#pragma once

#include "encode/size_search.h"

#include <brdf/metrics.h>

#include <functional>

namespace brdf::encode {

/// Tries the recipes, coarse verification first; the file returned meets the target at search.level under `full`.
/// Throws Error(target_not_met) with the best value that was reached. Not dependent on the number of threads.
Encoded encode_to_error(const SourceData& source, const Search& search, const ErrorTarget& target, const Verification& full,
                        const std::function<void(double share)>& done);

}  // namespace brdf::encode

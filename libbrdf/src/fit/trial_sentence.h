// SPDX-License-Identifier: Apache-2.0
// Says in words why a lobe is there or not.
#pragma once

#include "fit/search.h"

#include <string>

namespace brdf::fit {

/// "ggx" and so on.
const char* kind_name(LobeKind kind) noexcept;

/// For example "ggx alpha 0.12: BIC fell from -812.4 to -2903.1".
std::string trial_sentence(const Trial& trial, double required);

}  // namespace brdf::fit

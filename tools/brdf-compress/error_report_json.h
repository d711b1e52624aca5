// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "json_report.h"

#include <brdf/metrics.h>

namespace brdf::cli {

/// Adds every figure of `report` to the object `row`, bands and single lights included.
void add_errors(Json& row, const ErrorReport& report);

}  // namespace brdf::cli

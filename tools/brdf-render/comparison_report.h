// SPDX-License-Identifier: Apache-2.0
// What is said about two pictures, as JSON and as text.
#pragma once

#include "image/comparison.h"
#include "json_report.h"

#include <string>

namespace brdf::cli {

/// Adds "figures", each with value, noise_floor and without_noise (null where there is none), and "mean_difference".
void add_comparison(Json& row, const render::ComparisonResult& result);

/// The table of figures.
std::string comparison_table(const render::ComparisonResult& result);

}  // namespace brdf::cli

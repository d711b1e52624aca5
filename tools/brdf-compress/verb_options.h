// SPDX-License-Identifier: Apache-2.0
// Options that several verbs share, so that they read the same everywhere.
#pragma once

#include "material_source.h"
#include "options.h"
#include "row_options.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace brdf::cli {

void add_position(CLI::App& verb, SamplePosition& position);
/// Names of the presets, and the help lines "name  effort  purpose".
std::vector<std::string> preset_names();
std::string preset_help();
/// Effort of a preset by name. Throws CLI::ValidationError.
int preset_effort(const std::string& name);

}  // namespace brdf::cli

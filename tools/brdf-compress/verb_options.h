// SPDX-License-Identifier: Apache-2.0
// Options that several verbs share, so that they read the same everywhere.
#pragma once

#include "material_source.h"
#include "options.h"
#include "row_format.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace brdf::cli {

void add_eval_level(CLI::App& verb, EvalLevel& level);
void add_prefix(CLI::App& verb, std::optional<std::uint64_t>& prefix);
void add_position(CLI::App& verb, SamplePosition& position);
void add_row_format(CLI::App& verb, RowFormat& format);
/// Names of the presets, and the help lines "name  effort  purpose".
std::vector<std::string> preset_names();
std::string preset_help();
/// Effort of a preset by name. Throws CLI::ValidationError.
int preset_effort(const std::string& name);

}  // namespace brdf::cli

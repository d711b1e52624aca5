// SPDX-License-Identifier: Apache-2.0
// Options that several verbs share, so that they read the same everywhere.
#pragma once

#include "material_source.h"
#include "messages.h"
#include "row_format.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace brdf::cli {

void add_reporting(CLI::App& verb, Reporting& reporting, bool json = true);
void add_eval_level(CLI::App& verb, EvalLevel& level);
void add_prefix(CLI::App& verb, std::optional<std::uint64_t>& prefix);
void add_position(CLI::App& verb, SamplePosition& position);
void add_row_format(CLI::App& verb, RowFormat& format);
void add_force(CLI::App& verb, bool& force);
/// --threads N; 0 stands for every processor and is resolved by thread_count.
void add_threads(CLI::App& verb, int& threads);
int thread_count(int wanted) noexcept;

/// Accepts decimal digits that fit 64 bits, at least `least`: CLI11 itself would wrap "-5" round.
CLI::Validator natural_number(std::uint64_t least = 0);
/// The parts of "a,b,c".
std::vector<std::string> split_list(const std::string& text);

/// "a, b or c", for sentences and help.
std::string listed(const std::vector<std::string>& words);

/// Names of the presets, and the help lines "name  effort  purpose".
std::vector<std::string> preset_names();
std::string preset_help();
/// Effort of a preset by name. Throws CLI::ValidationError.
int preset_effort(const std::string& name);

}  // namespace brdf::cli

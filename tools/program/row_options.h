// SPDX-License-Identifier: Apache-2.0
// Options of eval, pdf and sample, in whichever program.
#pragma once

#include "row_format.h"

#include <brdf/material.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>

namespace brdf::cli {

void add_eval_level(CLI::App& verb, EvalLevel& level);
void add_prefix(CLI::App& verb, std::optional<std::uint64_t>& prefix);
void add_row_format(CLI::App& verb, RowFormat& format);

}  // namespace brdf::cli

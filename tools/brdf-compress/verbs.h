// SPDX-License-Identifier: Apache-2.0
// One function per verb: declares its options and says what to run when it is chosen.
#pragma once

#include "verb.h"

#include <string>

namespace brdf::cli {

Verb add_compress(CLI::App& program);
/// Writes an analytic material.
Verb add_model(CLI::App& program);
Verb add_decompress(CLI::App& program);
Verb add_convert(CLI::App& program);
Verb add_info(CLI::App& program);
Verb add_verify(CLI::App& program);
Verb add_compare(CLI::App& program);
Verb add_where(CLI::App& program);
/// `command_line` is what made the program run; it is stated beside tables that go into documents.
Verb add_bench(CLI::App& program, const std::string& command_line);
Verb add_eval(CLI::App& program);
Verb add_sample(CLI::App& program);
Verb add_pdf(CLI::App& program);
Verb add_profile(CLI::App& program);
/// Only where brdf::render is built.
Verb add_plan(CLI::App& program);

}  // namespace brdf::cli

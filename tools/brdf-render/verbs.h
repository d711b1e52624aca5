// SPDX-License-Identifier: Apache-2.0
// One function per verb: declares its options and says what to run when it is chosen.
#pragma once

#include "verb.h"

#include <string>

namespace brdf::cli {

/// The verb that a command line without one means. `command_line` goes into the picture's metadata.
Verb add_render(CLI::App& program, const std::string& command_line);

Verb add_compare(CLI::App& program, const std::string& command_line);
Verb add_difference(CLI::App& program);
Verb add_export(CLI::App& program);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// From a command line to what it asks for.
#pragma once

#include "exit_codes.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace brdf::cli {

/// Parses `arguments`, those after the program's name in their order, and runs `chosen`. What cannot be parsed becomes one
/// sentence on stderr that names the help of the verb, and ExitCode::usage; help and version go to stdout.
ExitCode parse_and_run(CLI::App& program, std::vector<std::string> arguments, const std::function<ExitCode()>& chosen);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// One function per verb: declares its options and says what to run when it is chosen.
#pragma once

#include "exit_codes.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace brdf::cli {

struct Verb {
  CLI::App* app;
  std::function<ExitCode()> run;  ///< throws Error, Failure or CLI::ValidationError
};

/// The verb that a command line without one means. `command_line` goes into the picture's metadata.
Verb add_render(CLI::App& program, const std::string& command_line);

}  // namespace brdf::cli

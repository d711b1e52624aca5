// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exit_codes.h"

#include <functional>
#include <string>

namespace brdf::cli {

/// What main returns: runs `body` with the signal handlers installed, and turns what it throws into one sentence on stderr and an
/// exit code.
int run_program(const std::string& name, const std::function<ExitCode()>& body);

}  // namespace brdf::cli

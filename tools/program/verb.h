// SPDX-License-Identifier: Apache-2.0
// A verb of a program's command line.
#pragma once

#include "exit_codes.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <span>

namespace brdf::cli {

struct Verb {
  CLI::App* app;
  std::function<ExitCode()> run;  ///< throws Error, Failure or CLI::ValidationError
};

/// Runs the one that the command line named. Precondition: the program requires a subcommand and was parsed.
inline ExitCode run_chosen(std::span<const Verb> verbs) {
  return std::find_if(verbs.begin(), verbs.end(), [](const Verb& v) { return v.app->parsed(); })->run();
}

}  // namespace brdf::cli

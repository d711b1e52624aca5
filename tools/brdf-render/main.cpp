// SPDX-License-Identifier: Apache-2.0
// brdf-render: pictures of scenes whose materials are measured, compressed or analytic.
#include <brdf/version.h>

#include "command_line.h"
#include "messages.h"
#include "run_program.h"
#include "standard_output.h"
#include "verbs.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace brdf;
using namespace brdf::cli;

constexpr const char* footer =
    "'brdf-render SCENE.json ...' is short for 'brdf-render render SCENE.json ...'.\n"
    "Exit codes: 0 ok, 1 failed, 2 usage, 3 bad input, 130 interrupted (what there was is written).\n"
    "stdout carries data, stderr messages. 'brdf-render VERB --help' has examples.";

ExitCode usage_error(const CLI::App& program, const std::string& sentence) {
  const auto chosen = program.get_subcommands();
  const std::string verb = chosen.empty() ? "" : chosen.front()->get_name() + " ";
  complain(sentence + "; see brdf-render " + verb + "--help");
  return ExitCode::usage;
}

ExitCode run(int argc, char** argv) {
  CLI::App program{"Renders scenes with measured, compressed and analytic materials.", "brdf-render"};
  program.set_version_flag("--version", std::string("brdf-render ") + version());
  program.require_subcommand(1);
  program.footer(footer);
  const std::array verbs{add_render(program, command_line("brdf-render", argc, argv))};

  // CLI11 takes arguments from the last to the first.
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_ours = [&verbs](const std::string& word) {
    return word == "--help" || word == "-h" || word == "--version" ||
           std::any_of(verbs.begin(), verbs.end(), [&word](const Verb& v) { return v.app->get_name() == word; });
  };
  if (!arguments.empty() && !is_ours(arguments.front())) arguments.insert(arguments.begin(), "render");
  std::reverse(arguments.begin(), arguments.end());
  try {
    program.parse(arguments);
    const auto chosen = std::find_if(verbs.begin(), verbs.end(), [](const Verb& v) { return v.app->parsed(); });
    return chosen->run();
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) return usage_error(program, e.what());
    std::ostringstream text;  // --help or --version
    program.exit(e, text, text);
    print(text.str());
    return ExitCode::ok;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("brdf-render", [=] { return run(argc, argv); });
}

// SPDX-License-Identifier: Apache-2.0
// brdf-render: pictures of scenes whose materials are measured, compressed or analytic.
#include <brdf/version.h>

#include "command_line.h"
#include "parse_arguments.h"
#include "run_program.h"
#include "verbs.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace brdf;
using namespace brdf::cli;

constexpr const char* footer =
    "'brdf-render SCENE.json ...' is short for 'brdf-render render SCENE.json ...'.\n"
    "Exit codes: 0 ok, 1 failed, 2 usage, 3 bad input, 130 interrupted (what there was is written).\n"
    "stdout carries data, stderr messages. 'brdf-render VERB --help' has examples.";

ExitCode run(int argc, char** argv) {
  CLI::App program{"Renders scenes with measured, compressed and analytic materials.", "brdf-render"};
  program.set_version_flag("--version", std::string("brdf-render ") + version());
  program.require_subcommand(1);
  program.footer(footer);
  const std::string line = command_line("brdf-render", argc, argv);
  const std::array verbs{add_render(program, line), add_compare(program, line), add_difference(program), add_export(program)};

  std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto is_ours = [&verbs](const std::string& word) {
    return word == "--help" || word == "-h" || word == "--version" ||
           std::any_of(verbs.begin(), verbs.end(), [&word](const Verb& v) { return v.app->get_name() == word; });
  };
  if (!arguments.empty() && !is_ours(arguments.front())) arguments.insert(arguments.begin(), "render");
  return parse_and_run(program, std::move(arguments), [&verbs] { return run_chosen(verbs); });
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("brdf-render", [=] { return run(argc, argv); });
}

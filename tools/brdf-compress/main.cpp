// SPDX-License-Identifier: Apache-2.0
// brdf-compress: measured BRDFs to a few kilobytes and back, and every question about them.
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

namespace {

using namespace brdf;
using namespace brdf::cli;

constexpr const char* exit_codes_help =
    "Exit codes: 0 ok, 1 failed, 2 usage, 3 bad input, 4 target not met, 5 some of a batch failed.\n"
    "stdout carries data, stderr messages. 'brdf-compress VERB --help' has examples.";

ExitCode usage_error(const CLI::App& program, const std::string& sentence) {
  const auto chosen = program.get_subcommands();
  const std::string verb = chosen.empty() ? "" : chosen.front()->get_name() + " ";
  complain(sentence + "; see brdf-compress " + verb + "--help");
  return ExitCode::usage;
}

ExitCode run(int argc, char** argv) {
  CLI::App program{"Compresses measured BRDFs, and evaluates, samples, verifies and compares them.", "brdf-compress"};
  program.set_version_flag("--version", std::string("brdf-compress ") + version());
  program.require_subcommand(1);
  program.footer(exit_codes_help);
  const std::array verbs{add_compress(program),
                         add_decompress(program),
                         add_convert(program),
                         add_info(program),
                         add_verify(program),
                         add_compare(program),
                         add_where(program),
                         add_bench(program, command_line("brdf-compress", argc, argv)),
                         add_eval(program),
                         add_sample(program),
                         add_pdf(program)};
  try {
    program.parse(argc, argv);
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
  return run_program("brdf-compress", [=] { return run(argc, argv); });
}

// SPDX-License-Identifier: Apache-2.0
// brdf-compress: measured BRDFs to a few kilobytes and back, and every question about them.
#include <brdf/version.h>

#include "command_line.h"
#include "parse_arguments.h"
#include "run_program.h"
#include "verbs.h"

#include <CLI/CLI.hpp>

#include <array>
#include <string>

namespace {

using namespace brdf;
using namespace brdf::cli;

constexpr const char* exit_codes_help =
    "Exit codes: 0 ok, 1 failed, 2 usage, 3 bad input, 4 target not met, 5 some of a batch failed.\n"
    "stdout carries data, stderr messages. 'brdf-compress VERB --help' has examples.";

ExitCode run(int argc, char** argv) {
  CLI::App program{"Compresses measured BRDFs, and evaluates, samples, verifies and compares them.", "brdf-compress"};
  program.set_version_flag("--version", std::string("brdf-compress ") + version());
  program.require_subcommand(1);
  program.footer(exit_codes_help);
  const std::array verbs{add_compress(program),
                         add_model(program),
                         add_decompress(program),
                         add_convert(program),
                         add_info(program),
                         add_verify(program),
                         add_compare(program),
                         add_where(program),
                         add_bench(program, command_line("brdf-compress", argc, argv)),
                         add_eval(program),
                         add_sample(program),
                         add_pdf(program),
#ifdef BRDF_HAVE_RENDER
                         add_plan(program),
#endif
                         add_profile(program)};
  return parse_and_run(program, {argv + 1, argv + argc}, [&verbs] { return run_chosen(verbs); });
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("brdf-compress", [=] { return run(argc, argv); });
}

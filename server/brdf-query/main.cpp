// SPDX-License-Identifier: Apache-2.0
// brdf-query: asks a brdfd what brdf-compress asks a file.
#include "connection.h"
#include "messages.h"
#include "parse_arguments.h"
#include "run_program.h"
#include "shared/error_table.h"
#include "shared/silence_grpc.h"
#include "verbs.h"

#include <brdf/version.h>

#include <array>

namespace {

using namespace brdf;
using cli::ExitCode;

constexpr const char* footer =
    "Exit codes: 0 ok, 1 failed (no server, overload, no permission), 2 usage, 3 bad input or no such material, 4 target not met.\n"
    "eval, pdf and sample read and write the rows of brdf-compress.\n\n"
    "Example: echo 0,0,1,0.6,0,0.8 | brdf-query --server unix:/run/brdfd.sock eval gold";

/// Where the library's error is known, its own exit code; otherwise that of the status.
ExitCode exit_code_of(const client::CallError& e) {
  for (const service::ErrorRow& row : service::error_table())
    if (e.library_code() == to_string(row.code)) return static_cast<ExitCode>(row.exit_code);
  return static_cast<ExitCode>(service::exit_code_of(e.code()));
}

ExitCode run(int argc, char** argv) {
  CLI::App program{"Asks a brdfd about its materials.", "brdf-query"};
  program.set_version_flag("--version", std::string("brdf-query ") + version());
  program.require_subcommand(1);
  program.footer(footer);
  query::Connection connection;
  query::add_connection(program, connection);
  using namespace query;
  const std::array verbs{add_list(program, connection), add_info(program, connection),    add_fetch(program, connection),
                         add_eval(program, connection), add_sample(program, connection),  add_pdf(program, connection),
                         add_similar(program, connection), add_compress(program, connection), add_health(program, connection)};
  try {
    return cli::parse_and_run(program, {argv + 1, argv + argc}, [&verbs] { return cli::run_chosen(verbs); });
  } catch (const client::CallError& e) {
    cli::complain(e.what());
    return exit_code_of(e);
  }
}

}  // namespace

int main(int argc, char** argv) {
  service::silence_grpc();
  return cli::run_program("brdf-query", [&] { return run(argc, argv); });
}

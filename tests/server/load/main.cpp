// SPDX-License-Identifier: Apache-2.0
// brdf-load: what the daemon does under load. Starts the programs that it needs, sends traffic to unix sockets and the loopback only, and
// ends by itself.
#include "server/load/echo_service.h"
#include "server/load/rows.h"

#include <CLI/CLI.hpp>

#include <sched.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace brdf::load {

const std::vector<NamedRow>& all_rows() {
  static const std::vector<NamedRow> rows{
      {"throughput", measure_throughput}, {"small-call", measure_small_call}, {"fetch", measure_fetch}, {"overload", measure_overload}, {"replicas", measure_replicas}, {"swaps", measure_swaps}, {"hostile", measure_hostile}, {"flood", measure_flood}, {"compress", measure_compress}, {"soak", measure_soak},
  };
  return rows;
}

namespace {

/// Load and daemon share the first two processors that this process may use, whatever else the machine has.
void use_two_processors() {
  cpu_set_t allowed, two;
  CPU_ZERO(&two);
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return;
  int taken = 0;
  for (std::size_t i = 0; i < CPU_SETSIZE && taken < 2; ++i) {
    if (!CPU_ISSET(i, &allowed)) continue;
    CPU_SET(i, &two);
    ++taken;
  }
  ::sched_setaffinity(0, sizeof(two), &two);
}

/// Thousands of connections need as many descriptors here, too.
void raise_descriptors() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// This program is a test and not in the folder of what is installed, which lies beside its own.
std::string program(const std::string& given, const char* variable, const std::string& name, const fs::path& self) {
  if (!given.empty()) return given;
  if (const char* value = std::getenv(variable)) return value;
  return (self.parent_path().parent_path() / "bin" / name).string();
}

int run(int argc, char** argv) {
  CLI::App app{"Loads brdfd and says what it did: a table of what is asked and what was reached.", "brdf-load"};
  std::vector<std::string> wanted;
  std::string echo, json, daemon, compress, gonio;
  bool is_long = false, strict = false, sanitized = false;
  double soak_seconds = 0;
  std::string names;
  for (const NamedRow& r : all_rows()) names += (names.empty() ? "" : ", ") + r.name;
  app.add_option("row", wanted, "Rows: " + names + "; default: all");
  app.add_flag("--long", is_long, "The whole figures, about 20 minutes; without it each row takes some seconds and the soak two minutes");
  app.add_flag("--strict", strict, "Exit code 4 where a figure is missed, too");
  app.add_flag("--sanitized", sanitized, "The daemon was built with sanitizers: how its memory grows is printed, not judged");
  app.add_option("--soak-seconds", soak_seconds, "Default: 120, with --long 600")->check(CLI::Range(20.0, 86400.0));
  app.add_option("--json", json, "Also write the rows there, - for stdout in place of the table");
  app.add_option("--brdfd", daemon, "The daemon; default: $BRDFD, or ../bin beside this program");
  app.add_option("--brdf-compress", compress, "Default: $BRDF_COMPRESS, or ../bin beside this program");
  app.add_option("--brdf-gonio", gonio, "Default: $BRDF_GONIO, or ../bin beside this program");
  app.add_option("--echo", echo, "Serve the echo service at this address until SIGTERM, nothing else");
  app.footer("Exit code 1: something was wrong, a failed call, a mixed answer, a leak.");
  CLI11_PARSE(app, argc, argv);
  ::signal(SIGPIPE, SIG_IGN);
  if (!echo.empty()) return serve_echo(echo);
  use_two_processors();
  raise_descriptors();
  const fs::path self = fs::read_symlink("/proc/self/exe");
  Setup setup({program(daemon, "BRDFD", "brdfd", self), program(compress, "BRDF_COMPRESS", "brdf-compress", self), program(gonio, "BRDF_GONIO", "brdf-gonio", self), self.string()}, is_long);
  setup.is_sanitized = sanitized;
  setup.soak_seconds = soak_seconds;
  std::vector<Row> rows;
  for (const std::string& name : wanted) {
    const bool known = std::any_of(all_rows().begin(), all_rows().end(), [&](const NamedRow& r) { return r.name == name; });
    if (!known) throw std::runtime_error("there is no row '" + name + "', rows are " + names);
  }
  for (const NamedRow& r : all_rows()) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), r.name) == wanted.end()) continue;
    std::fprintf(stderr, "%s ...\n", r.name.c_str());
    for (Row& row : r.measure(setup)) rows.push_back(std::move(row));
  }
  if (json != "-") std::fputs(table_of(rows).c_str(), stdout);
  if (json == "-") std::fputs(json_of(rows).c_str(), stdout);
  if (!json.empty() && json != "-") std::ofstream(json) << json_of(rows);
  const bool sound = std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.sound; });
  const bool met = std::all_of(rows.begin(), rows.end(), [](const Row& r) { return r.met; });
  if (!sound) std::fputs(("what the programs said, at its end:\n" + setup.end_of_log()).c_str(), stderr);
  return !sound ? 1 : strict && !met ? 4 : 0;
}

}  // namespace
}  // namespace brdf::load

int main(int argc, char** argv) {
  try {
    return brdf::load::run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "brdf-load: %s\n", e.what());
    return 1;
  }
}

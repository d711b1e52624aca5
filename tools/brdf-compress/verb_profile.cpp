// SPDX-License-Identifier: Apache-2.0
// Looking at profiles of scenes, and adding them up.
#include "output_file.h"
#include "profile_input.h"
#include "profile_report.h"
#include "standard_output.h"
#include "verb_options.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string shown, output;
  std::vector<std::string> merged;
  bool force = false;
  Reporting reporting;
  CLI::App* show = nullptr;
};

ExitCode show(const Options& o) {
  const Json rows = profile_rows(read_profile(o.shown));
  print(o.reporting.json ? json_report("profile", rows) : profile_text(rows));
  return ExitCode::ok;
}

ExitCode merge(const Options& o) {
  for (const std::string& path : o.merged) check_output(o.output, path, o.force);
  Profile sum;
  for (const std::string& path : o.merged) sum.merge(read_profile(path));
  const std::vector<std::byte> bytes = sum.write();
  write_output(o.output, bytes, o.force);
  o.reporting.say(o.output + ": " + std::to_string(sum.materials.size()) + " materials of " + std::to_string(o.merged.size()) + " profiles, " +
                  std::to_string(bytes.size()) + " bytes");
  return ExitCode::ok;
}

}  // namespace

Verb add_profile(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("profile", "Show what a scene asked of its materials, or add such profiles up");
  verb->require_subcommand(1);
  o->show = verb->add_subcommand("show", "Tables of what was asked, and where");
  o->show->add_option("PROFILE", o->shown, "A profile, written by a renderer")->required();
  add_reporting(*o->show, o->reporting);
  CLI::App* merging = verb->add_subcommand("merge", "Add profiles up, material by material");
  merging->add_option("PROFILE", o->merged, "Profiles of the same or other scenes")->required();
  merging->add_option("-o,--output", o->output, "File to write")->type_name("OUT.prof")->required();
  add_force(*merging, o->force);
  verb->footer("Examples:\n"
               "  brdf-compress profile show scene.prof\n"
               "  brdf-compress profile merge morning.prof evening.prof -o day.prof");
  return {verb, [o] { return o->show->parsed() ? show(*o) : merge(*o); }};
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "delta_checks.h"
#include "json_report.h"
#include "material_checks.h"
#include "material_source.h"
#include "progress_bar.h"
#include "recorded_checks.h"
#include "sampling_checks.h"
#include "standard_output.h"
#include "text_table.h"
#include "verb_options.h"
#include "verbs.h"

#include <brdf/check.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace brdf::cli {
namespace {

struct Options {
  std::string file, reference;
  std::optional<std::uint64_t> prefix;
  SamplePosition position = SamplePosition::edge;
  int threads = 0;
  Reporting reporting;
};

void append(Checks& all, Checks more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::string figure(double value) { return value == std::floor(value) ? fixed(value, 0) : significant(value, 4); }

std::string table(const Checks& checks) {
  TextTable t;
  t.header = {"", "check", "found", "allowed", "where"};
  t.left_columns = 5;
  for (const Check& c : checks) t.rows.push_back({c.ok ? "ok" : "FAILED", c.name, figure(c.value), c.allowed, c.note});
  return t.terminal();
}

Json json_rows(const Checks& checks) {
  Json rows = Json::array();
  for (const Check& c : checks) {
    Json row;
    row["check"] = c.name;
    row["ok"] = c.ok;
    row["value"] = c.value;
    row["allowed"] = c.allowed;
    row["where"] = c.note;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Whether the tables of each level are within the limits that decode has by default, and how large the largest are.
Checks memory_checks(const FileCheck& check) {
  Checks checks;
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    const LevelCheck& found = check.at(level);
    checks.push_back({"memory is within the limits", check.readable(level),
                      static_cast<double>(found.table_bytes + found.temporary_bytes), "the default limits of decode",
                      std::string("at ") + to_string(level) + (found.problem ? std::string(", ") + found.problem->what() : "")});
  }
  return checks;
}

Checks examine(const Options& o) {
  ProgressBar bar(o.reporting);
  bar.show("reading", 0);
  const MaterialSource file = MaterialSource::open(o.file, {EvalLevel::balanced, o.prefix, {}});
  if (!file.is_compressed()) throw Failure(ExitCode::bad_input, o.file + ": is a measured file and no .brdfc");
  std::optional<MaterialSource> reference;
  if (!o.reference.empty()) reference = MaterialSource::open(o.reference, {EvalLevel::exact, {}, o.position});

  Checks checks{{"the file decodes", true, static_cast<double>(file.bytes().size()), "checksums and structure",
                 "bytes, " + std::to_string(file.material().info().refinements_read) + " of " +
                     std::to_string(file.material().info().refinements_total) + " refinements"}};
  const FileCheck found = check_file(file.bytes(), {}, true);
  append(checks, memory_checks(found));
  checks.push_back(prefix_check(file.bytes(), file.path()));
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    bar.show("values", 0.05);
    if (!found.readable(level)) continue;
    append(checks, value_checks(file.material().prepare(level)));
  }
  checks.push_back(albedo_check(file.material()));
  double done = 0.1;
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    bar.show("sampling", done);
    const Material material = file.material().prepare(level);
    append(checks, (material.scatter_flags() & sample_delta) != 0 ? delta_checks(material) : sampling_checks(material));
    done += 0.1;
  }
  if (reference) append(checks, recorded_checks(file, *reference, thread_count(o.threads), bar));
  return checks;
}

ExitCode run(const Options& o) {
  const Checks checks = examine(o);
  print(o.reporting.json ? json_report("verify", json_rows(checks)) : table(checks));
  const auto failed = std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.ok; });
  if (failed == 0) return ExitCode::ok;
  const auto first = std::find_if(checks.begin(), checks.end(), [](const Check& c) { return !c.ok; });
  throw Failure(ExitCode::failed, o.file + ": " + std::to_string(failed) + " of " + std::to_string(checks.size()) +
                                      " checks failed, the first is '" + first->name + "' " + first->note);
}

}  // namespace

Verb add_verify(CLI::App& program) {
  auto o = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand("verify", "Check that a .brdfc file is sound, and as good as it says");
  verb->add_option("FILE", o->file, "A .brdfc file")->required();
  verb->add_option("--against", o->reference, "The measured file it was made from: checks the recorded errors")
      ->type_name("MEASURED");
  add_prefix(*verb, o->prefix);
  add_position(*verb, o->position);
  add_threads(*verb, o->threads);
  add_reporting(*verb, o->reporting);
  verb->footer(
      "Checks structure, every prefix, values at every level (finite, not negative, reciprocal where declared), and\n"
      "that sample, pdf and eval agree at every level, for views from the normal to 89.9 degrees. Exit code 0: all\n"
      "passed, 1: a check failed, 3: the file cannot be read.\n\n"
      "Examples:\n"
      "  brdf-compress verify gold.brdfc\n"
      "  brdf-compress verify gold.brdfc --against gold.binary --json");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "compared_pair.h"
#include "error_report_json.h"
#include "progress_bar.h"
#include "standard_output.h"
#include "text_table.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

Json json_row(const PairOptions& o, const MaterialSource& candidate, const ErrorReport& report) {
  Json row;
  row["reference"] = o.reference;
  row["candidate"] = o.candidate;
  row["eval_level"] = candidate.is_compressed() ? Json(to_string(o.source.level)) : Json(nullptr);
  row["bytes"] = candidate.is_compressed() ? candidate.bytes().size() : candidate.file_bytes();
  if (candidate.is_compressed()) {
    row["refinements_read"] = candidate.material().info().refinements_read;
    row["refinements_total"] = candidate.material().info().refinements_total;
  }
  add_errors(row, report);
  return row;
}

std::string table(const ErrorReport& r) {
  TextTable bands;
  bands.header = {"error", "all", "0-60", "60-75", "75-85", "85-90", "p95", "max"};
  const auto add = [&](const char* name, const BandedError& e) {
    bands.rows.push_back({name, significant(e.all), significant(e.band[0]), significant(e.band[1]),
                          significant(e.band[2]), significant(e.band[3]), significant(e.p95), significant(e.max)});
  };
  add("log_mae", r.log_mae);
  add("cbrt_rms", r.cbrt_rms);
  TextTable whole;
  whole.header = {"cos_l2", "albedo_error", "psnr_env", "psnr_lights", "front",
                  "deg45",  "grazing",      "top",      "not finite",  "negative"};
  whole.left_columns = 0;
  whole.rows = {{significant(r.cos_l2), significant(r.albedo_error), fixed(r.psnr_env, 2), fixed(r.psnr_lights, 2),
                 fixed(r.psnr_light[0], 2), fixed(r.psnr_light[1], 2), fixed(r.psnr_light[2], 2),
                 fixed(r.psnr_light[3], 2), std::to_string(r.not_finite), std::to_string(r.negative)}};
  return bands.terminal() + '\n' + whole.terminal();
}

ExitCode run(const PairOptions& o) {
  const auto [reference, candidate] = open_pair(o);
  const int channels = reference.channels().count;
  ProgressBar bar(o.reporting);
  bar.show("reference", 0);
  const Comparison comparison(reference.rows(), channels, 1.0, thread_count(o.threads));
  bar.show("candidate", 0.7);
  const ErrorReport report = comparison.score(candidate.rows());
  bar.clear();
  print(o.reporting.json ? json_report("compare", Json::array({json_row(o, candidate, report)})) : table(report));
  return ExitCode::ok;
}

}  // namespace

Verb add_compare(CLI::App& program) {
  auto o = std::make_shared<PairOptions>();
  CLI::App* verb = program.add_subcommand("compare", "Every error figure of one file against another");
  add_pair(*verb, *o, "The candidate, a measured or .brdfc file");
  verb->footer(
      "Errors are means over independent directions, uniform in solid angle, by the larger angle from the normal "
      "(bands in\n"
      "degrees; 'all' is below 85). PSNR in dB of a lit sphere, at most 60.\n\n"
      "Examples:\n"
      "  brdf-compress compare gold.binary gold.brdfc\n"
      "  brdf-compress compare gold.binary gold.brdfc --eval exact --json");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli

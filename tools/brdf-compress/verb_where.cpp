// SPDX-License-Identifier: Apache-2.0
#include "compared_pair.h"
#include "error_bands.h"
#include "error_report_json.h"
#include "progress_bar.h"
#include "standard_output.h"
#include "text_table.h"
#include "verbs.h"

#include <memory>

namespace brdf::cli {
namespace {

/// What a refinement of a file costs, and what it brought.
struct Part {
  std::string name;
  std::uint64_t bytes;
  const RecordedError* error;  ///< null when none is recorded at the level
};

std::vector<Part> parts_of(const MaterialSource& candidate, EvalLevel level) {
  std::vector<Part> parts;
  if (!candidate.is_compressed()) return parts;
  const std::vector<std::uint64_t> ends = refinement_boundaries(candidate.bytes());
  const MaterialInfo& info = candidate.material().info();
  std::uint64_t before = 0;
  for (std::size_t k = 0; k < ends.size() && ends[k] <= candidate.bytes().size(); ++k) {
    const EvalLevel recorded = k == 0 ? EvalLevel::fast : level == EvalLevel::fast ? EvalLevel::balanced : level;
    const RecordedError* found = nullptr;
    for (const RecordedError& e : info.errors)
      if (e.refinement == static_cast<int>(k) && e.level == recorded) found = &e;
    parts.push_back({k == 0 ? "lobes" : "refinement " + std::to_string(k), ends[k] - before, found});
    before = ends[k];
  }
  return parts;
}

std::string band_name(const ErrorBand& band) {
  if (band.axis == "none") return "nothing";
  if (band.axis == "channel") return "channel " + fixed(band.from, 0);
  return band.axis + " " + significant(band.from) + " to " + significant(std::min(band.to, 90.0));
}

std::string tables(const std::vector<Part>& parts, const std::vector<ErrorBand>& bands, const std::vector<ErrorReport>& reports) {
  std::string text;
  if (!parts.empty()) {
    TextTable spent;
    spent.header = {"bytes go to", "bytes", "then log_mae", "psnr_env"};
    for (const Part& p : parts)
      spent.rows.push_back({p.name, std::to_string(p.bytes), p.error != nullptr ? significant(p.error->log_mae) : "-",
                            p.error != nullptr ? fixed(p.error->psnr_env, 1) : "-"});
    text += spent.terminal() + '\n';
  }
  TextTable table;
  table.header = {"if perfect", "log_mae", "psnr_env", "psnr_lights", "front", "deg45", "grazing", "top", "albedo_error"};
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const ErrorReport& r = reports[i];
    table.rows.push_back({band_name(bands[i]), significant(r.log_mae.all), fixed(r.psnr_env, 2), fixed(r.psnr_lights, 2),
                          fixed(r.psnr_light[0], 2), fixed(r.psnr_light[1], 2), fixed(r.psnr_light[2], 2),
                          fixed(r.psnr_light[3], 2), significant(r.albedo_error)});
  }
  return text + table.terminal();
}

Json json_rows(const std::vector<Part>& parts, const std::vector<ErrorBand>& bands, const std::vector<ErrorReport>& reports) {
  Json rows = Json::array();
  for (const Part& p : parts) {
    Json row;
    row["part"] = p.name;
    row["bytes"] = p.bytes;
    row["log_mae"] = p.error != nullptr ? Json(p.error->log_mae) : Json(nullptr);
    row["psnr_env"] = p.error != nullptr ? Json(p.error->psnr_env) : Json(nullptr);
    rows.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < bands.size(); ++i) {
    Json row;
    row["perfect"] = bands[i].axis;
    row["from"] = bands[i].from;
    row["to"] = std::min(bands[i].to, 90.0);
    add_errors(row, reports[i]);
    rows.push_back(std::move(row));
  }
  return rows;
}

ExitCode run(const PairOptions& o) {
  const auto [reference, candidate] = open_pair(o);
  const int channels = reference.channels().count;
  ProgressBar bar(o.reporting);
  bar.show("reference", 0);
  const BatchEval truth = reference.rows(), tried = candidate.rows();
  const Comparison comparison(truth, channels, 0.3, thread_count(o.threads));
  const std::vector<ErrorBand> bands = error_bands(channels);
  std::vector<ErrorReport> reports;
  for (const ErrorBand& band : bands) {
    bar.show(band_name(band), static_cast<double>(reports.size() + 1) / static_cast<double>(bands.size() + 1));
    reports.push_back(score_without(comparison, band, truth, tried));
  }
  bar.clear();
  const std::vector<Part> parts = parts_of(candidate, o.source.level);
  print(o.reporting.json ? json_report("where", json_rows(parts, bands, reports)) : tables(parts, bands, reports));
  return ExitCode::ok;
}

}  // namespace

Verb add_where(CLI::App& program) {
  auto o = std::make_shared<PairOptions>();
  CLI::App* verb = program.add_subcommand("where", "Where the bytes of a file go, and where its errors are");
  add_pair(*verb, *o, "The candidate, usually a .brdfc file");
  verb->footer(
      "Refinements go from low to high frequency; each states its bytes and the error recorded with it. Then the figures\n"
      "that the candidate would have if it were perfect within one band of angles (degrees), or in one channel: the larger\n"
      "the gain over the row 'nothing', the more of the error is there. On three tenths of the rows that 'compare' uses.\n\n"
      "Examples:\n"
      "  brdf-compress where gold.binary gold.brdfc\n"
      "  brdf-compress where gold.binary gold.brdfc --eval exact --json");
  return {verb, [o] { return run(*o); }};
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "compress_report.h"

#include "info_report.h"
#include "text_table.h"

#include <brdf/version.h>

#include <algorithm>

namespace brdf::cli {
namespace {

double seconds(const EncodeSummary& s) {
  return s.seconds_fit + s.seconds_residual + s.seconds_verify;
}

double ratio(const CompressReport& r, double source_bytes) {
  return source_bytes / static_cast<double>(std::max<std::uint64_t>(r.summary.bytes, 1));
}

std::string preset_name(int effort) {
  for (const Preset& p : presets())
    if (p.effort == effort) return std::string(p.name);
  return "effort " + std::to_string(effort);
}

/// The figures of the whole file: the lobes alone at `fast`, the last refinement at the other levels.
std::vector<RecordedError> final_errors(const EncodeSummary& s) {
  std::vector<RecordedError> last;
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    const RecordedError* found = nullptr;
    for (const RecordedError& e : s.errors)
      if (e.level == level && (found == nullptr || e.refinement >= found->refinement)) found = &e;
    if (found != nullptr) last.push_back(*found);
  }
  return last;
}

}  // namespace

std::vector<std::string> summary_lines(const CompressReport& r) {
  const EncodeSummary& s = r.summary;
  std::vector<std::string> lines;
  lines.push_back(r.output + ": " + std::to_string(s.bytes) + " bytes, " +
                  significant(ratio(r, static_cast<double>(r.measurement.provenance.file_bytes)), 4) +
                  " times smaller than the file; lobes " + std::to_string(s.lobe_bytes) + ", residual " +
                  std::to_string(s.residual_bytes) + " in " + std::to_string(s.refinements) +
                  " refinements, overhead " + std::to_string(s.overhead_bytes) +
                  (s.cdf_bytes > 0 ? ", sampling tables " + std::to_string(s.cdf_bytes) : std::string()));
  std::string errors = "errors:";
  for (const RecordedError& e : final_errors(s)) {
    errors += std::string(errors.back() == ':' ? " " : "; ") + to_string(e.level) + " log_mae " +
              significant(e.log_mae) + ", psnr_env " + fixed(e.psnr_env, 1) + " dB";
  }
  lines.push_back(errors);
  if (r.options.profile) lines.push_back("where the scene looks: relative rms " + significant(s.profile.rms) + ", log error " + significant(s.profile.log_error));
  if (!s.left_out.empty()) lines.push_back(s.left_out);
  // measured files are rarely symmetric: what that meant is said, unless nothing had to be decided
  if (s.reciprocity_asymmetry > 0 || r.options.reciprocity != SymmetryMode::automatic) lines.push_back(s.reciprocity);
  if (s.mirror_asymmetry > 0 || r.options.mirror != SymmetryMode::automatic) lines.push_back(s.mirror);
  if (s.largest_albedo > 1 || r.options.energy != EnergyMode::report) lines.push_back(s.energy);
  lines.push_back(preset_name(r.options.effort) + ", " + fixed(seconds(s), 2) + " s; " + s.fit.stop_reason);
  return lines;
}

std::vector<std::string> detail_lines(const CompressReport& r) {
  const EncodeSummary& s = r.summary;
  std::vector<std::string> lines;
  for (const LobeReason& lobe : s.fit.lobes) {
    lines.push_back((lobe.kept ? "  kept     " : "  refused  ") + lobe.sentence);
  }
  lines.push_back("  solver: " + s.fit.solver_message);
  lines.push_back("  seconds: fit " + fixed(s.seconds_fit, 2) +
                  ", residual " + fixed(s.seconds_residual, 2) + ", verify " + fixed(s.seconds_verify, 2));
  return lines;
}

Json json_row(const CompressReport& r) {
  const EncodeSummary& s = r.summary;
  Json row;
  row["input"] = r.input;
  row["output"] = r.output;
  row["material"] = r.measurement.provenance.name;
  row["preset"] = preset_name(r.options.effort);
  row["effort"] = r.options.effort;
  row["target_size"] = r.options.target_size ? Json(*r.options.target_size) : Json(nullptr);
  row["target_metric"] = r.options.target_error ? Json(to_string(r.options.target_error->metric)) : Json(nullptr);
  row["target_error"] = r.options.target_error ? Json(r.options.target_error->value) : Json(nullptr);
  row["eval_level"] = to_string(r.options.level);
  row["bytes"] = s.bytes;
  row["ratio"] = ratio(r, static_cast<double>(r.measurement.provenance.file_bytes));
  row["lobe_bytes"] = s.lobe_bytes;
  row["residual_bytes"] = s.residual_bytes;
  row["overhead_bytes"] = s.overhead_bytes;
  row["cdf_bytes"] = s.cdf_bytes;
  row["refinements"] = s.refinements;
  row["coefficients"] = s.coefficients;
  row["reciprocal"] = s.reciprocal;
  row["reciprocity"] = s.reciprocity;
  row["reciprocity_asymmetry"] = s.reciprocity_asymmetry;
  row["mirror"] = s.mirror;
  row["mirror_asymmetry"] = s.mirror_asymmetry;
  row["energy"] = s.energy;
  row["largest_albedo"] = s.largest_albedo;
  row["source_albedo"] = s.source_albedo;
  row["energy_scale"] = s.energy_scale;
  row["stop_reason"] = s.fit.stop_reason;
  row["lobes"] = Json::array();
  for (const LobeReason& lobe : s.fit.lobes) {
    Json entry;
    entry["kind"] = lobe_name(lobe.kind);
    entry["kept"] = lobe.kept;
    entry["criterion_before"] = lobe.criterion_before;
    entry["criterion_after"] = lobe.criterion_after;
    entry["reason"] = lobe.sentence;
    row["lobes"].push_back(std::move(entry));
  }
  row["errors"] = Json::array();
  for (const RecordedError& e : s.errors) {
    Json entry;
    entry["refinement"] = e.refinement;
    entry["level"] = to_string(e.level);
    entry["log_mae"] = e.log_mae;
    entry["psnr_env"] = e.psnr_env;
    row["errors"].push_back(std::move(entry));
  }
  if (r.options.profile) row["profile"] = {{"rms", s.profile.rms}, {"log_error", s.profile.log_error}, {"share", r.options.profile_share}, {"left_out", s.left_out}};
  row["seconds"] = seconds(s);
  row["seconds_fit"] = s.seconds_fit;
  row["seconds_residual"] = s.seconds_residual;
  row["seconds_verify"] = s.seconds_verify;
  row["threads"] = r.options.threads;
  row["version"] = version();
  return row;
}

}  // namespace brdf::cli

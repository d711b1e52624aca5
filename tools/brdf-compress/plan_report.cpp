// SPDX-License-Identifier: Apache-2.0
#include "plan_report.h"

#include "text_table.h"

#include <algorithm>

namespace brdf::cli {
namespace {

Json figure(const render::Figure& f) { return {{"value", f.value}, {"noise_floor", f.floor ? Json(*f.floor) : Json()}}; }

std::string number(const Json& value, int digits = 3) { return value.is_number() ? significant(value.get<double>(), digits) : "-"; }

std::string with_floor(const Json& f) {
  return f.is_null() ? "-" : number(f["value"]) + (f["noise_floor"].is_null() ? "" : " (noise " + number(f["noise_floor"], 2) + ")");
}

}  // namespace

Json plan_rows(const std::string& scene, const std::vector<PlanSlot>& slots, const PlanChoice& choice, const std::vector<PlannedFile>& files,
               const PlanPicture* picture) {
  Json rows = Json::array();
  std::uint64_t source_bytes = 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const PlanSlot& slot = slots[i];
    const TradePoint& p = slot.points[choice.point[i]];
    source_bytes += slot.measurement.provenance.file_bytes;
    Json row{{"slot", slot.name}, {"source", slot.source}, {"source_bytes", slot.measurement.provenance.file_bytes}};
    row["share"] = slot.share;
    row["footprint_pixels"] = slot.profile.footprint_pixels();
    row["bytes"] = p.bytes;
    row["level"] = to_string(p.level);
    row["representation"] = to_string(p.representation);
    row["lobes"] = p.lobes;
    row["refinements"] = p.refinements;
    row["ns_per_eval"] = p.nanoseconds;
    row["expected_error"] = p.error.log_error;
    row["expected_log_error"] = p.error.log_error;
    row["file"] = files[i].file.empty() ? Json() : Json(files[i].file);
    row["flip"] = files[i].flip ? figure(*files[i].flip) : Json();
    rows.push_back(row);
  }
  Json whole{{"slot", nullptr}, {"scene", scene}, {"source_bytes", source_bytes}, {"bytes", choice.bytes}};
  whole["ns_per_eval"] = choice.nanoseconds;
  whole["expected_error"] = choice.expected;
  if (picture) {
    whole["flip"] = figure(picture->result.flip);
    whole["psnr"] = figure(picture->result.psnr);
    whole["relative_mse"] = figure(picture->result.relative_mse);
    whole["spp"] = picture->pair.spp;
  }
  rows.push_back(whole);
  return rows;
}

std::string plan_text(const Json& rows) {
  TextTable table;
  table.header = {"slot", "holds", "level", "bytes", "ns/eval", "% of light", "pixels", "expected error", "FLIP alone"};
  std::string files;
  for (const Json& row : rows) {
    if (row["slot"].is_null()) {
      table.rows.push_back({"all", "", "", std::to_string(row["bytes"].get<std::uint64_t>()), number(row["ns_per_eval"]), "", "", number(row["expected_error"]),
                            row.contains("flip") ? with_floor(row["flip"]) : "-"});
      continue;
    }
    std::string holds = row["representation"];
    if (holds == "lobes") holds = std::to_string(row["lobes"].get<int>()) + " lobes";
    table.rows.push_back({row["slot"], holds, row["level"], std::to_string(row["bytes"].get<std::uint64_t>()), number(row["ns_per_eval"]),
                          number(100 * row["share"].get<double>()), number(row["footprint_pixels"]), number(row["expected_error"]), with_floor(row["flip"])});
    if (!row["file"].is_null()) files += " --material " + row["slot"].get<std::string>() + "=" + row["file"].get<std::string>() + ",eval=" + row["level"].get<std::string>();
  }
  table.left_columns = 3;
  std::string text = table.terminal();
  const Json& whole = rows.back();
  if (whole.contains("psnr"))
    text += "\nrendered: FLIP " + with_floor(whole["flip"]) + ", PSNR " + number(whole["psnr"]["value"], 4) + " dB, relative MSE " + number(whole["relative_mse"]["value"]) +
            "; " + std::to_string(whole["spp"].get<int>()) + " samples per pixel\n";
  if (!files.empty()) text += "\nbrdf-render " + whole["scene"].get<std::string>() + files + " -o OUT.exr\n";
  return text;
}

}  // namespace brdf::cli

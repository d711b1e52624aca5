// SPDX-License-Identifier: Apache-2.0
// The report of `info` for people.
#include "info_report.h"
#include "ingest/printable_text.h"
#include "text_table.h"

namespace brdf::cli {
namespace {

class Facts {
 public:
  Facts& add(const std::string& what, const std::string& value) {
    // names and descriptions come from the file
    if (!value.empty()) table_.rows.push_back({what, ingest::printable_text(value)});
    return *this;
  }
  std::string text() {
    table_.header = table_.rows.front();  // no heading: the first fact is the first line
    table_.rows.erase(table_.rows.begin());
    table_.left_columns = 2;
    return table_.terminal();
  }

 private:
  TextTable table_;
};

std::string percent(double fraction) { return significant(100 * fraction) + " %"; }

std::string channels(const Json& row) {
  std::string text = std::to_string(row["channels"].get<int>()) + " (" + row["channel_model"].get<std::string>();
  const Json& nm = row["wavelengths_nm"];
  if (!nm.empty()) text += ", " + significant(nm.front(), 4) + " to " + significant(nm.back(), 4) + " nm";
  return text + ")";
}

/// Bytes of each level.
std::string by_level(const Json& levels) {
  std::string text;
  for (const auto& [level, bytes] : levels.items())
    text += (text.empty() ? "" : ", ") + level + " " + (bytes.is_null() ? "beyond the limits" : std::to_string(bytes.get<std::uint64_t>()));
  return text;
}

std::string word(const Json& row, const char* key) { return row[key].get<std::string>(); }

std::string colour(const Json& values) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t c = 0; c < std::min(values.size(), most); ++c)
    text += (c > 0 ? " " : "") + significant(values[c], 4);
  return values.size() > most ? text + " ..." : text;
}

/// "ggx, alpha_x 0.1, ..."; empty without a model.
std::string model_text(const Json& model) {
  if (model.is_null()) return "";
  std::string text = word(model, "kind");
  for (const auto& [name, value] : model.items()) {
    if (value.is_number()) text += ", " + name + " " + significant(value, 4);
    if (value.is_array()) text += ", " + name + " " + colour(value);
    if (value.is_boolean() && value.get<bool>()) text += ", " + name;
  }
  return text;
}

std::string refinement_table(const Json& list) {
  TextTable table;
  table.header = {"refinement", "ends at byte", "level", "log_mae", "psnr_env"};
  table.left_columns = 0;
  for (const Json& entry : list) {
    const std::string number = std::to_string(entry["refinement"].get<int>());
    const std::string end = std::to_string(entry["ends_at"].get<std::uint64_t>());
    if (!entry["present"].get<bool>()) table.rows.push_back({number, end, "not read", "", ""});
    for (const Json& e : entry["errors"]) {
      table.rows.push_back({number, end, word(e, "level"), significant(e["log_mae"]), fixed(e["psnr_env"], 2)});
    }
  }
  return table.terminal();
}

std::string lobe_table(const Json& list) {
  TextTable table;
  table.header = {"lobe", "alpha", "f90", "colour (rho or f0)"};
  for (const Json& lobe : list) {
    const bool rough = lobe.contains("alpha");
    table.rows.push_back({word(lobe, "kind"), rough ? significant(lobe["alpha"], 4) : "",
                          rough ? significant(lobe["f90"], 4) : "", colour(lobe["color"])});
  }
  return table.terminal();
}

}  // namespace

std::string measured_text(const Json& row) {
  std::string shape;
  for (const Json& n : row["table"]) shape += (shape.empty() ? "" : " x ") + std::to_string(n.get<std::uint64_t>());
  return Facts()
      .add("file", word(row, "file"))
      .add("format", word(row, "format"))
      .add("name", word(row, "name"))
      .add("description", word(row, "description"))
      .add("licence", word(row, "licence"))
      .add("bytes", std::to_string(row["file_bytes"].get<std::uint64_t>()))
      .add("hash (XXH3-64)", word(row, "content_hash"))
      .add("channels", channels(row))
      .add("table", shape)
      .add("cells", std::to_string(row["cells"].get<std::uint64_t>()))
      .add("numbers", std::to_string(row["numbers"].get<std::uint64_t>()))
      .add("cells not measured", percent(row["invalid_fraction"]))
      .add("negative values", percent(row["negative_fraction"]))
      .add("reciprocity asymmetry", significant(row["reciprocity_asymmetry"]))
      .add("mirror asymmetry", significant(row["mirror_asymmetry"]))
      .add("largest albedo", significant(row["max_albedo"], 4))
      .add("largest f, 1/sr", significant(row["max_value"], 4))
      .text();
}

std::string compressed_text(const Json& row) {
  std::string albedo;
  for (const auto& [level, value] : row["largest_albedo"].items())
    albedo += (albedo.empty() ? "" : ", ") + level + " " + significant(value, 4) + (value.get<double>() > 1 ? " (more than it receives)" : "");
  const auto number = [&](const char* key) { return std::to_string(row[key].get<std::uint64_t>()); };
  const std::string facts = Facts()
                                .add("file", word(row, "file"))
                                .add("format", "brdfc " + number("format_version"))
                                .add("name", word(row, "name"))
                                .add("source format", word(row, "format"))
                                .add("description", word(row, "description"))
                                .add("licence", word(row, "licence"))
                                .add("source hash", word(row, "content_hash"))
                                .add("written by", word(row, "fitter"))
                                .add("model", model_text(row["model"]))
                                .add("bytes", number("bytes_read") + " of " + number("total_bytes"))
                                .add("refinements", number("refinements_read") + " of " + number("refinements_total"))
                                .add("channels", channels(row))
                                .add("reciprocal", row["reciprocal"].get<bool>() ? "exactly" : "no")
                                .add("mirror symmetric", row["mirror_symmetric"].get<bool>() ? "yes" : "no")
                                .add("largest albedo", albedo)
                                .add("resident bytes", by_level(row["resident_bytes"]))
                                .add("bytes while decoding", by_level(row["temporary_bytes"]))
                                .text();
  if (!row["model"].is_null()) return facts;
  return facts + '\n' + lobe_table(row["lobes"]) + '\n' + refinement_table(row["refinements"]);
}

}  // namespace brdf::cli

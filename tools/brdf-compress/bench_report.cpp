// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <brdf/version.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace brdf::cli {
namespace {

/// A column of figures. The worst of several is the largest, or the smallest.
struct Figure {
  const char* heading;
  std::function<double(const BenchRow&)> value;
  std::function<std::string(double)> text;
  bool smallest_is_worst = false;
};

std::string three_digits(double v) { return significant(v, 3); }
std::string whole(double v) { return fixed(v, 0); }
std::string tenths(double v) { return fixed(v, 1); }
std::string hundredths(double v) { return fixed(v, 2); }

std::vector<Figure> figures(bool against_raw) {
  std::vector<Figure> list{
      {"bytes", [](const BenchRow& r) { return static_cast<double>(r.bytes); }, whole},
      {"ratio", [](const BenchRow& r) { return r.ratio; }, whole, true},
      {"native", [](const BenchRow& r) { return r.ratio_native; }, whole, true},
      {"encode s", [](const BenchRow& r) { return r.encode_s; }, hundredths},
      {"decode us", [](const BenchRow& r) { return r.decode_us; }, whole},
      {"KiB", [](const BenchRow& r) { return static_cast<double>(r.resident_bytes) / 1024; }, tenths},
      {"eval ns", [](const BenchRow& r) { return r.eval_ns; }, tenths},
      {"pdf ns", [](const BenchRow& r) { return r.pdf_ns; }, tenths},
      {"sample ns", [](const BenchRow& r) { return r.sample_ns; }, tenths},
      {"scalar eval", [](const BenchRow& r) { return r.eval_ns_scalar; }, tenths},
      {"scalar pdf", [](const BenchRow& r) { return r.pdf_ns_scalar; }, tenths},
      {"scalar sample", [](const BenchRow& r) { return r.sample_ns_scalar; }, tenths}};
  if (against_raw) {
    list.push_back({"raw ns", [](const BenchRow& r) { return r.raw_eval_ns; }, tenths});
    list.push_back({"scalar raw", [](const BenchRow& r) { return r.raw_eval_ns_scalar; }, tenths});
    list.push_back({"times faster", [](const BenchRow& r) { return r.raw_eval_ns / r.eval_ns; }, tenths, true});
  }
  const std::vector<Figure> errors{
      {"log_mae", [](const BenchRow& r) { return r.errors.log_mae.all; }, three_digits},
      {"75-85", [](const BenchRow& r) { return r.errors.log_mae.band[2]; }, three_digits},
      {"max", [](const BenchRow& r) { return r.errors.log_mae.max; }, three_digits},
      {"psnr_env", [](const BenchRow& r) { return r.errors.psnr_env; }, hundredths, true},
      {"psnr_lights", [](const BenchRow& r) { return r.errors.psnr_lights; }, hundredths, true},
      {"albedo", [](const BenchRow& r) { return r.errors.albedo_error; }, three_digits},
      {"bugs", [](const BenchRow& r) { return static_cast<double>(r.bugs); }, three_digits}};
  list.insert(list.end(), errors.begin(), errors.end());
  return list;
}

std::string target_text(const BenchRow& row) { return row.target ? std::to_string(*row.target) : "-"; }

bool same_setting(const BenchRow& a, const BenchRow& b) {
  return a.preset == b.preset && a.target == b.target && a.level == b.level;
}

std::vector<std::string> labels(const std::string& material, const BenchRow& row) {
  return {material, row.preset, target_text(row), row.level ? to_string(*row.level) : "-"};
}

/// Mean or worst of a column over rows of one setting.
using Summary = std::function<double(const Figure&, std::span<const BenchRow* const>)>;

double mean_of(const Figure& figure, std::span<const BenchRow* const> rows) {
  double sum = 0;
  for (const BenchRow* row : rows) sum += figure.value(*row);
  return sum / static_cast<double>(rows.size());
}

double worst_of(const Figure& figure, std::span<const BenchRow* const> rows) {
  double worst = figure.value(*rows.front());
  for (const BenchRow* row : rows) {
    const double v = figure.value(*row);
    worst = figure.smallest_is_worst ? std::min(worst, v) : std::max(worst, v);
  }
  return worst;
}

void add_summaries(TextTable& table, std::span<const BenchRow> rows, const std::vector<Figure>& columns,
                   const std::string& name, const Summary& summary) {
  std::vector<const BenchRow*> seen;
  for (const BenchRow& row : rows) {
    if (std::any_of(seen.begin(), seen.end(), [&](const BenchRow* s) { return same_setting(*s, row); })) continue;
    seen.push_back(&row);
    std::vector<const BenchRow*> alike;
    for (const BenchRow& other : rows)
      if (same_setting(row, other)) alike.push_back(&other);
    if (alike.size() < 2) continue;
    std::vector<std::string> line = labels(name, row);
    for (const Figure& figure : columns) line.push_back(figure.text(summary(figure, alike)));
    table.rows.push_back(std::move(line));
  }
}

}  // namespace

Json bench_json(std::span<const BenchRow> rows) {
  Json list = Json::array();
  for (const BenchRow& r : rows) {
    Json row;
    row["material"] = r.material;
    row["preset"] = r.preset;
    row["effort"] = r.effort ? Json(*r.effort) : Json(nullptr);
    row["target"] = r.target ? Json(*r.target) : Json(nullptr);
    row["eval_level"] = r.level ? Json(to_string(*r.level)) : Json(nullptr);
    row["bytes"] = r.bytes;
    row["ratio"] = r.ratio;
    row["ratio_native"] = r.ratio_native;
    row["encode_s"] = r.encode_s;
    row["decode_us"] = r.decode_us;
    row["resident_bytes"] = r.resident_bytes;
    row["eval_ns"] = r.eval_ns;
    row["eval_ns_scalar"] = r.eval_ns_scalar;
    row["pdf_ns"] = r.pdf_ns;
    row["pdf_ns_scalar"] = r.pdf_ns_scalar;
    row["sample_ns"] = r.sample_ns;
    row["sample_ns_scalar"] = r.sample_ns_scalar;
    row["raw_eval_ns"] = r.raw_eval_ns;
    row["raw_eval_ns_scalar"] = r.raw_eval_ns_scalar;
    row["log_mae"] = r.errors.log_mae.all;
    row["log_mae_0_60"] = r.errors.log_mae.band[0];
    row["log_mae_60_75"] = r.errors.log_mae.band[1];
    row["log_mae_75_85"] = r.errors.log_mae.band[2];
    row["log_mae_85_90"] = r.errors.log_mae.band[3];
    row["log_mae_p95"] = r.errors.log_mae.p95;
    row["log_mae_max"] = r.errors.log_mae.max;
    row["psnr_env"] = r.errors.psnr_env;
    row["psnr_lights"] = r.errors.psnr_lights;
    row["albedo_error"] = r.errors.albedo_error;
    row["simd"] = r.simd;
    row["threads"] = r.threads;
    row["version"] = version();
    row["bugs"] = r.bugs;
    list.push_back(std::move(row));
  }
  return list;
}

std::string bench_csv(std::span<const BenchRow> rows) {
  TextTable table;
  for (const Json& row : bench_json(rows)) {
    std::vector<std::string> line;
    for (const auto& [key, value] : row.items()) {
      if (table.rows.empty()) table.header.push_back(key);
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      line.push_back(text == "null" ? "" : text);  // also what JSON makes of a number that is not finite
    }
    table.rows.push_back(std::move(line));
  }
  return table.csv();
}

TextTable bench_table(std::span<const BenchRow> rows, bool against_raw) {
  const std::vector<Figure> columns = figures(against_raw);
  TextTable table;
  table.header = {"material", "preset", "target", "eval"};
  table.left_columns = 4;
  for (const Figure& figure : columns) table.header.emplace_back(figure.heading);
  for (const BenchRow& row : rows) {
    std::vector<std::string> line = labels(row.material, row);
    for (const Figure& figure : columns) line.push_back(figure.text(figure.value(row)));
    table.rows.push_back(std::move(line));
  }
  add_summaries(table, rows, columns, "mean", mean_of);
  add_summaries(table, rows, columns, "worst", worst_of);
  return table;
}

}  // namespace brdf::cli

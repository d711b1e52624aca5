// SPDX-License-Identifier: Apache-2.0
#include "comparison_report.h"

#include "image/differences.h"
#include "image/figure_text.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

namespace brdf::cli {
namespace {

using namespace brdf::render;

/// A figure is told without noise where two standard deviations of chance leave something of it.
std::optional<double> above_chance(const std::optional<WithoutNoise>& estimate) {
  if (!estimate || estimate->value <= 2 * estimate->deviation) return std::nullopt;
  return estimate->value;
}

std::optional<double> without_noise(const ComparisonResult& result, std::string_view key) {
  if (key == "mse") return above_chance(result.mse_without_noise);
  if (key == "relative_mse") return above_chance(result.relative_mse_without_noise);
  if (key == "psnr") {
    if (const auto mse = above_chance(result.displayed_mse_without_noise)) return psnr_of(*mse);
  }
  return std::nullopt;
}

Json number(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

std::string line(const std::array<std::string, 4>& cells) {
  std::string text = cells[0];
  text.resize(std::max<std::size_t>(text.size(), 18), ' ');
  for (std::size_t i = 1; i < cells.size(); ++i) text += std::string(15 - std::min<std::size_t>(14, cells[i].size()), ' ') + cells[i];
  return text + '\n';
}

std::string scientific(double value, const char* format) {
  std::array<char, 32> text{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"  // both callers pass a literal
  std::snprintf(text.data(), text.size(), format, value);
#pragma GCC diagnostic pop
  return text.data();
}

}  // namespace

void add_comparison(Json& row, const ComparisonResult& result) {
  Json figures;
  for (const FigureRow& figure : figure_rows(result)) {
    figures[figure.key] = {{"value", figure.figure.value},
                           {"noise_floor", number(figure.figure.floor)},
                           {"without_noise", number(without_noise(result, figure.key))}};
  }
  row["figures"] = std::move(figures);
  row["mean_difference"] = {{"value", result.mean_signed}, {"standard_deviation", number(result.mean_signed_deviation)}};
}

std::string comparison_table(const ComparisonResult& result) {
  std::string table = line({"", "value", "noise floor", "without noise"});
  for (const FigureRow& figure : figure_rows(result)) {
    table += line({figure.name, figure_text(figure, figure.figure.value), figure_text(figure, figure.figure.floor),
                   figure_text(figure, without_noise(result, figure.key))});
  }
  table += line({"mean difference", scientific(result.mean_signed, "%+.3g"),
                 result.mean_signed_deviation ? "+-" + scientific(*result.mean_signed_deviation, "%.2g") : "-", "-"});
  return table;
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "image/figure_text.h"

#include <array>
#include <cstdio>

namespace brdf::render {

std::vector<FigureRow> figure_rows(const ComparisonResult& result) {
  return {
      {"PSNR (dB)", "psnr", result.psnr, "%.2f"},
      {"SSIM", "ssim", result.ssim, "%.5f"},
      {"FLIP", "flip", result.flip, "%.5f"},
      {"HDR-FLIP", "hdr_flip", result.hdr_flip, "%.5f"},
      {"relative MSE", "relative_mse", result.relative_mse, "%.3g"},
      {"MSE", "mse", result.mse, "%.3g"},
      {"max difference", "max_difference", result.max_difference, "%.3g"},
      {"mean |difference|", "mean_absolute", result.mean_absolute, "%.3g"},
  };
}

std::string figure_text(const FigureRow& row, std::optional<double> value) {
  if (!value) return "-";
  std::array<char, 64> text{};
  // gcc cannot see that all formats are literals of the table above
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(text.data(), text.size(), row.format, *value);
#pragma GCC diagnostic pop
  return text.data();
}

std::string figure_line(const FigureRow& row) {
  std::string line = std::string(row.name) + " " + figure_text(row, row.figure.value);
  if (row.figure.floor) line += ", noise " + figure_text(row, row.figure.floor);
  return line;
}

}  // namespace brdf::render

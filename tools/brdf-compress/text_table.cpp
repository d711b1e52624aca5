// SPDX-License-Identifier: Apache-2.0
#include "text_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace brdf::cli {
namespace {

using Row = std::vector<std::string>;

std::string csv_cell(const std::string& cell) {
  if (cell.find_first_of(",\"\n\r") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string markdown_cell(const std::string& cell) {
  std::string escaped;
  for (const char c : cell) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string formatted(const char* format, int digits, double value) {
  std::array<char, 64> text;
  const int n = std::snprintf(text.data(), text.size(), format, digits, value);
  return {text.data(), std::min(static_cast<std::size_t>(std::max(n, 0)), text.size() - 1)};
}

}  // namespace

std::string TextTable::terminal() const {
  std::vector<std::size_t> width(header.size());
  const auto widen = [&](const Row& row) {
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  };
  widen(header);
  for (const Row& row : rows) widen(row);
  std::string text;
  const auto put = [&](const Row& row) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string pad(width[c] - row[c].size(), ' ');
      if (c > 0) line += "  ";
      line += c < static_cast<std::size_t>(left_columns) ? row[c] + pad : pad + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  };
  put(header);
  for (const Row& row : rows) put(row);
  return text;
}

std::string TextTable::csv() const {
  std::string text;
  const auto put = [&](const Row& row) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c > 0 ? "," : "") + csv_cell(row[c]);
    text += '\n';
  };
  put(header);
  for (const Row& row : rows) put(row);
  return text;
}

std::string TextTable::markdown() const {
  std::string text;
  const auto put = [&](const Row& row) {
    text += '|';
    for (const std::string& cell : row) text += ' ' + markdown_cell(cell) + " |";
    text += '\n';
  };
  put(header);
  text += '|';
  for (std::size_t c = 0; c < header.size(); ++c) text += c < static_cast<std::size_t>(left_columns) ? "---|" : "---:|";
  text += '\n';
  for (const Row& row : rows) put(row);
  return text;
}

std::string fixed(double value, int decimals) {
  return std::isfinite(value) ? formatted("%.*f", decimals, value) : "-";
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (exponent < -5 || exponent > 8) return formatted("%.*g", digits, value);
  return fixed(value, std::max(0, digits - 1 - exponent));
}

}  // namespace brdf::cli

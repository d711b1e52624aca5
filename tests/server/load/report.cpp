// SPDX-License-Identifier: Apache-2.0
#include "server/load/report.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace brdf::load {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

std::string formatted(const char* format, int digits, double value) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, digits, value);
  return text.data();
}

}  // namespace

std::string number(double value, int digits) {
  if (std::abs(value) >= 1000) return formatted("%.*f", 0, value);
  return formatted("%.*g", digits, value);
}

std::string duration(double seconds) {
  if (seconds < 1e-6) return number(seconds * 1e9) + " ns";
  if (seconds < 1e-3) return number(seconds * 1e6) + " us";
  if (seconds < 1) return number(seconds * 1e3) + " ms";
  return number(seconds) + " s";
}

std::string table_of(const std::vector<Row>& rows) {
  std::string out = "| | asked | reached | | what was run |\n|---|---|---|---|---|\n";
  for (const Row& r : rows) {
    out += "| " + r.name + " | " + r.asked + " | " + r.reached + " | " + (!r.sound ? "WRONG" : r.met ? "met" : "missed") + " | " + r.ran + " |\n";
  }
  return out;
}

std::string json_of(const std::vector<Row>& rows) {
  std::string out = "{\"rows\": [";
  for (const Row& r : rows) {
    out += (&r == rows.data() ? "\n  " : ",\n  ");
    out += "{\"name\": " + quoted(r.name) + ", \"asked\": " + quoted(r.asked) + ", \"reached\": " + quoted(r.reached) + ", \"ran\": " + quoted(r.ran) +
           ", \"met\": " + (r.met ? "true" : "false") + ", \"sound\": " + (r.sound ? "true" : "false") + ", \"figures\": {";
    for (const auto& [name, value] : r.figures) {
      out += (&name == &r.figures.front().first ? "" : ", ") + quoted(name) + ": " + (std::isfinite(value) ? formatted("%.*g", 9, value) : "null");
    }
    out += "}}";
  }
  return out + "\n]}\n";
}

}  // namespace brdf::load

// SPDX-License-Identifier: Apache-2.0
#include "encode/effort.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string>

namespace brdf::encode {
namespace {

constexpr Preset preset_table[] = {
    {"fastest", 0, "a first look: two lobes, one basis"},
    {"fast", 25, "batches of many materials"},
    {"medium", 50, "the default"},
    {"thorough", 75, "materials that ship"},
    {"exhaustive", 100, "the smallest error that the format reaches"},
};

constexpr EffortStep step_table[] = {
    //  effort lobes starts samples iter | bins, substeps | coeff | images | passes | variants | verify
    {0, 2, 1, 1200, 15, 36, 20, 14, 1, 350, 0.0, 2, 1, 1, 1, 0.03},
    {25, 2, 2, 2500, 30, 44, 26, 18, 1, 600, 0.0, 3, 1, 1, 2, 0.1},
    {50, 3, 3, 4000, 40, 48, 28, 20, 2, 900, 0.02, 4, 2, 1, 6, 0.3},
    {75, 4, 4, 6000, 60, 60, 32, 24, 2, 1500, 0.08, 5, 5, 3, 9, 0.4},
    {100, 4, 8, 8000, 100, 72, 40, 28, 3, 2400, 0.12, 7, 12, 5, 12, 1.0},
};

}  // namespace

std::span<const EffortStep> effort_steps() noexcept { return step_table; }

const EffortStep& effort_step(int effort) noexcept {
  const EffortStep* found = &step_table[0];
  for (const EffortStep& s : step_table)
    if (s.effort <= effort) found = &s;
  return *found;
}

}  // namespace brdf::encode

namespace brdf {
namespace {

using encode::EffortStep;

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

/// One line of the table: what it says about a step.
struct Column {
  const char* what;
  std::string (*of)(const EffortStep&);
};

constexpr Column columns[] = {
    {"lobes, at most", [](const EffortStep& s) { return number(s.max_lobes); }},
    {"starting points of a lobe", [](const EffortStep& s) { return number(s.starts); }},
    {"pairs of directions in the fit", [](const EffortStep& s) { return number(s.fit_samples); }},
    {"iterations of the fit", [](const EffortStep& s) { return number(s.fit_iterations); }},
    {"cells of the error model", [](const EffortStep& s) { return number(s.bins_h) + " x " + number(s.bins_d) + " x " + number(s.bins_p); }},
    {"samples of a cell", [](const EffortStep& s) { return number(s.substeps * s.substeps * s.substeps); }},
    {"coefficients to choose from, per channel", [](const EffortStep& s) { return number(s.coefficients); }},
    {"picture in the error model, share of its rows", [](const EffortStep& s) { return number(s.image_quality); }},
    {"passes of rate-distortion optimisation", [](const EffortStep& s) { return number(s.passes); }},
    {"bases in half/difference coordinates", [](const EffortStep& s) { return number(s.variants); }},
    {"ways to write slices", [](const EffortStep& s) { return number(s.slice_variants); }},
    {"balanced tables for slices", [](const EffortStep& s) { return number(s.table_variants); }},
    {"verification, share of the queries", [](const EffortStep& s) { return number(s.verify_quality); }},
};

}  // namespace

std::string effort_table() {
  std::string first = "| from effort |", rule = "|---|", names = "| preset |";
  for (const EffortStep& s : encode::effort_steps()) {
    first += " " + number(s.effort) + " |";
    rule += "---:|";
    const auto named = std::find_if(std::begin(encode::preset_table), std::end(encode::preset_table), [&](const Preset& p) { return p.effort == s.effort; });
    names += " " + (named != std::end(encode::preset_table) ? std::string(named->name) : std::string()) + " |";
  }
  std::string text = first + "\n" + rule + "\n" + names + "\n";
  for (const Column& c : columns) {
    text += std::string("| ") + c.what + " |";
    for (const EffortStep& s : encode::effort_steps()) text += " " + c.of(s) + " |";
    text += "\n";
  }
  return text;
}


std::span<const Preset> presets() noexcept { return encode::preset_table; }

}  // namespace brdf

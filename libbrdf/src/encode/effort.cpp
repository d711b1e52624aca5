// SPDX-License-Identifier: Apache-2.0
#include "encode/effort.h"

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
    {50, 3, 3, 4000, 40, 48, 28, 20, 2, 900, 0.02, 4, 2, 1, 5, 0.3},
    {75, 4, 4, 6000, 60, 60, 32, 24, 2, 1500, 0.08, 5, 5, 3, 8, 0.4},
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

std::span<const Preset> presets() noexcept { return encode::preset_table; }

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// What a plan does to the picture: rendered, not estimated.
#pragma once

#include "image/comparison.h"
#include "path/paired_render.h"
#include "plan_choice.h"

#include <optional>

namespace brdf::cli {

struct PlanPicture {
  render::ComparisonResult result;
  render::PairedRender pair;
};

/// Renders the scene with its measured files and with the choice, by the same paths. `only`: a single one of the slots is
/// exchanged. Throws Error(cancelled).
PlanPicture render_plan(const render::Scene& scene, const std::vector<PlanSlot>& slots, const PlanChoice& choice,
                        const render::RenderOptions& options, float exposure, const Progress& progress,
                        std::optional<std::size_t> only = {});

/// Smallest choice whose picture has at most this FLIP, found by halving the interval of budgets, on a scale of their logarithm,
/// with a rendering each time. Throws Error(target_not_met) with the FLIP of the largest choice.
PlanChoice choose_by_flip(const render::Scene& scene, const std::vector<PlanSlot>& slots, double flip, const render::RenderOptions& options,
                          float exposure, const Progress& progress);

}  // namespace brdf::cli

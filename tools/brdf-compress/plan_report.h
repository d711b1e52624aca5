// SPDX-License-Identifier: Apache-2.0
// What is said about a plan.
#pragma once

#include "json_report.h"
#include "plan_render.h"

#include <string>
#include <vector>

namespace brdf::cli {

/// What became of a slot once the plan was rendered.
struct PlannedFile {
  std::string file;                    ///< empty: nothing was written
  std::optional<render::Figure> flip;  ///< of the picture in which this slot alone is exchanged
};

/// One row per slot and one for the whole, "slot": null. `picture`: null before rendering.
Json plan_rows(const std::string& scene, const std::vector<PlanSlot>& slots, const PlanChoice& choice, const std::vector<PlannedFile>& files,
               const PlanPicture* picture);
std::string plan_text(const Json& rows);

}  // namespace brdf::cli

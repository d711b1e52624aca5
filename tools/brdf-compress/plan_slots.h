// SPDX-License-Identifier: Apache-2.0
// The material slots of a scene that a plan decides about: what each asks, and what each could hold.
#pragma once

#include "path/render_scene.h"

#include <brdf/profile.h>
#include <brdf/progress.h>
#include <brdf/trade.h>

#include <cstdint>
#include <string>
#include <vector>

namespace brdf::cli {

struct PlanSlot {
  std::uint32_t index = 0;  ///< of the scene's slots
  std::string name, source;
  Measurement measurement;
  MaterialProfile profile;
  double share = 0;         ///< of the contribution that all slots have
  std::vector<TradePoint> points;
};

struct TradeSettings {
  int effort = 25, threads = 1;
  std::vector<std::uint64_t> sizes;
};

/// Slots of the scene that hold a measured file, a shape has, and light reached. Spectra become RGB: more no picture asks. Throws Error where a file cannot be read.
std::vector<PlanSlot> plan_slots(const render::Scene& scene, const Profile& profile);

/// Renders the scene for its profile.
Profile scene_profile(const render::Scene& scene, const render::RenderOptions& options, const Progress& progress);

/// Fills in what each slot could hold: files of the sizes, each for the slot's own profile.
void measure_trades(std::vector<PlanSlot>& slots, const TradeSettings& settings, const Progress& progress);

/// How much the relative error of a slot's reflections counts in the squared error of the picture, to first order: its pixels
/// have the mean radiance contribution / footprint.
double picture_weight(const PlanSlot& slot) noexcept;

}  // namespace brdf::cli

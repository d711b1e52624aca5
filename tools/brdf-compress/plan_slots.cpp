// SPDX-License-Identifier: Apache-2.0
#include "plan_slots.h"

#include "bench_speed.h"
#include "path/profile_observer.h"
#include "surface/measured_table.h"
#include "surface/rgb_measurement.h"

#include <brdf/error.h>
#include <brdf/ingest.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace brdf::cli {

std::vector<PlanSlot> plan_slots(const render::Scene& scene, const Profile& profile) {
  std::vector<PlanSlot> slots;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    const render::MaterialSlot& slot = scene.materials[i];
    const auto asked = profile.materials.find(slot.name);
    if (!slot.used || !slot.surface.table() || asked == profile.materials.end() || asked->second.contribution() <= 0) continue;
    slots.push_back({i, slot.name, slot.source, render::rgb_measurement(slot.surface.table()->measurement()), asked->second, profile.share(slot.name), {}});
  }
  return slots;
}

Profile scene_profile(const render::Scene& scene, const render::RenderOptions& options, const Progress& progress) {
  const render::ProfileObservers recorders(scene, options);
  if (!render::render_scene(scene, options, progress, {}, recorders.observers()).complete) {
    throw Error(ErrorCode::cancelled, "cancelled while the scene was rendered for its profile");
  }
  return recorders.profile();
}

void measure_trades(std::vector<PlanSlot>& slots, const TradeSettings& settings, const Progress& progress) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    PlanSlot& slot = slots[i];
    TradeOptions options;
    options.encode.effort = settings.effort;
    options.encode.threads = settings.threads;
    options.encode.profile = std::make_shared<const MaterialProfile>(slot.profile);
    if (!settings.sizes.empty()) options.sizes = settings.sizes;
    options.nanoseconds = single_eval_nanoseconds;
    slot.points = measure_trade(slot.measurement, options, [&](std::string_view, double done) {
      return !progress || progress(slot.name, (static_cast<double>(i) + done) / static_cast<double>(slots.size()));
    });
  }
}

double picture_weight(const PlanSlot& slot) noexcept {
  const double contribution = slot.profile.contribution();
  return contribution * contribution / std::max(slot.profile.footprint_pixels(), 1.0);
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "plan_render.h"

#include "text_table.h"

#include <brdf/error.h>

#include <cmath>
#include <utility>

namespace brdf::cli {
namespace {

constexpr int halvings = 7;

Material decoded(const TradePoint& p) {
  DecodeOptions options;
  options.level = p.level;
  return Material::decode(*p.file, options);
}

}  // namespace

PlanPicture render_plan(const render::Scene& scene, const std::vector<PlanSlot>& slots, const PlanChoice& choice,
                        const render::RenderOptions& options, float exposure, const Progress& progress, std::optional<std::size_t> only) {
  std::vector<render::Surface> reference = render::surfaces_for(scene, render::Sampling::mis), candidate = reference;
  std::vector<std::uint32_t> exchanged;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (only && *only != i) continue;
    candidate[slots[i].index] = render::Surface::from_material(decoded(slots[i].points[choice.point[i]]));
    exchanged.push_back(slots[i].index);
  }
  render::share_proposals(reference, candidate, exchanged);
  PlanPicture picture;
  picture.pair = render::render_pair(scene, reference, candidate, options, progress);
  if (!picture.pair.complete) throw Error(ErrorCode::cancelled, "cancelled while the plan was rendered");
  picture.result = render::compare_images(picture.pair.reference, picture.pair.candidate, picture.pair.noise, exposure);
  return picture;
}

PlanChoice choose_by_flip(const render::Scene& scene, const std::vector<PlanSlot>& slots, double flip, const render::RenderOptions& options,
                          float exposure, const Progress& progress) {
  const auto flip_of = [&](const PlanChoice& choice, int step) {
    const Progress part = [&](std::string_view, double done) {
      return !progress || progress("looking for the target", (step + done) / (halvings + 2));
    };
    return render_plan(scene, slots, choice, options, exposure, part).result.flip.value;
  };
  double below = static_cast<double>(fewest_bytes(slots)), above = static_cast<double>(most_bytes(slots));
  PlanChoice best = choose_by_bytes(slots, above);
  const double least = flip_of(best, 0);
  if (least > flip) {
    throw Error(ErrorCode::target_not_met, "FLIP " + significant(flip) + " cannot be reached: the largest files that were made, " +
                                               std::to_string(best.bytes) + " bytes together, reach " + significant(least));
  }
  if (PlanChoice smallest = choose_by_bytes(slots, below); flip_of(smallest, 1) <= flip) return smallest;
  for (int i = 0; i < halvings; ++i) {
    const double middle = std::sqrt(below * above);
    PlanChoice choice = choose_by_bytes(slots, middle);
    if (flip_of(choice, i + 2) <= flip) {
      above = static_cast<double>(choice.bytes);
      best = std::move(choice);
    } else {
      below = middle;
    }
    if (above <= 1.02 * below) break;
  }
  return best;
}

}  // namespace brdf::cli

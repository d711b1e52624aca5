// SPDX-License-Identifier: Apache-2.0
#include "plan_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace brdf::cli {
namespace {

using Cost = std::function<double(const PlanSlot&, const TradePoint&)>;

double evaluations(const PlanSlot& slot) noexcept {
  return static_cast<double>(slot.profile.operations[static_cast<std::size_t>(ProfileOperation::eval)]) +
         static_cast<double>(slot.profile.operations[static_cast<std::size_t>(ProfileOperation::sample)]);
}

double all_evaluations(const std::vector<PlanSlot>& slots) noexcept {
  double sum = 0;
  for (const PlanSlot& slot : slots) sum += evaluations(slot);
  return std::max(sum, 1.0);
}

/// Share of the slot's evaluations times what one takes.
double time_of(const PlanSlot& slot, const TradePoint& p, double all) noexcept { return p.nanoseconds * evaluations(slot) / all; }

PlanChoice choose(const std::vector<PlanSlot>& slots, double budget, const Cost& cost) {
  std::vector<std::vector<Alternative>> items;
  std::vector<double> weights;
  double whole = 0;
  for (const PlanSlot& slot : slots) {
    std::vector<Alternative>& alternatives = items.emplace_back();
    for (const TradePoint& p : slot.points) alternatives.push_back({cost(slot, p), p.error.log_error * p.error.log_error});
    weights.push_back(picture_weight(slot));
    whole += weights.back();
  }
  const Allocation a = allocate(items, weights, budget);
  PlanChoice choice;
  choice.point = a.choice;
  choice.expected = whole > 0 ? std::sqrt(a.error / whole) : 0;
  const double all = all_evaluations(slots);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const TradePoint& p = slots[i].points[choice.point[i]];
    choice.bytes += p.bytes;
    choice.nanoseconds += time_of(slots[i], p, all);
  }
  return choice;
}

std::uint64_t bytes_of(const std::vector<PlanSlot>& slots, bool (*better)(std::uint64_t, std::uint64_t)) {
  std::uint64_t sum = 0;
  for (const PlanSlot& slot : slots) {
    std::uint64_t best = slot.points.front().bytes;
    for (const TradePoint& p : slot.points)
      if (better(p.bytes, best)) best = p.bytes;
    sum += best;
  }
  return sum;
}

}  // namespace

PlanChoice choose_by_bytes(const std::vector<PlanSlot>& slots, double bytes) {
  return choose(slots, bytes, [](const PlanSlot&, const TradePoint& p) { return static_cast<double>(p.bytes); });
}

PlanChoice choose_by_time(const std::vector<PlanSlot>& slots, double nanoseconds) {
  const double all = all_evaluations(slots);
  return choose(slots, nanoseconds, [all](const PlanSlot& slot, const TradePoint& p) { return time_of(slot, p, all); });
}

std::uint64_t fewest_bytes(const std::vector<PlanSlot>& slots) {
  return bytes_of(slots, [](std::uint64_t a, std::uint64_t b) { return a < b; });
}

std::uint64_t most_bytes(const std::vector<PlanSlot>& slots) {
  return bytes_of(slots, [](std::uint64_t a, std::uint64_t b) { return a > b; });
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Which point of its trade each slot gets.
#pragma once

#include "plan_slots.h"

#include <cstddef>
#include <vector>

namespace brdf::cli {

/// A point for each slot, and what all cost.
struct PlanChoice {
  std::vector<std::size_t> point;  ///< of each slot
  std::uint64_t bytes = 0;         ///< of all files
  double nanoseconds = 0;          ///< of an evaluation, the mean over those that the scene asked for
  double expected = 0;             ///< relative error of the picture, to first order: an upper bound where errors cancel in a pixel
};

/// The least error with files of at most this many bytes together. Throws Error(target_not_met) with the smallest budget.
PlanChoice choose_by_bytes(const std::vector<PlanSlot>& slots, double bytes);

/// The least error with evaluations of at most this many nanoseconds on the average; of two points that are as exact, the smaller.
/// Throws Error(target_not_met) with the smallest budget.
PlanChoice choose_by_time(const std::vector<PlanSlot>& slots, double nanoseconds);

/// Bytes of the smallest and of the largest choice.
std::uint64_t fewest_bytes(const std::vector<PlanSlot>& slots);
std::uint64_t most_bytes(const std::vector<PlanSlot>& slots);

}  // namespace brdf::cli

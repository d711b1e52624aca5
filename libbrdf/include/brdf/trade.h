// SPDX-License-Identifier: Apache-2.0
/// @file trade.h
/// What each byte and each nanosecond buys for a material and a scene, and how to share a budget among materials.
#pragma once

#include <brdf/encode.h>
#include <brdf/material.h>
#include <brdf/measurement.h>
#include <brdf/metrics.h>
#include <brdf/progress.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace brdf {

/// What a file consists of.
enum class Representation : std::uint8_t { single_lobe, lobes, half_difference, slices };
const char* to_string(Representation r) noexcept;

/// One way to hold a material: a file, and at which level it is evaluated.
struct TradePoint {
  std::shared_ptr<const std::vector<std::byte>> file;
  std::uint64_t bytes = 0;            ///< of the file
  EvalLevel level = EvalLevel::fast;
  Representation representation = Representation::lobes;
  int lobes = 0, refinements = 0;
  ProfileError error;                 ///< of the decoded file at `level`
  double nanoseconds = 0;             ///< of one evaluation, as TradeOptions::nanoseconds found it; NaN without one
  std::uint64_t resident_bytes = 0;   ///< tables that evaluation touches
};

struct TradeOptions {
  /// Effort, symmetries, threads, profile. Targets and level are those of the points; the profile must be there.
  EncodeOptions encode;
  /// Sizes of the files that are made, bytes; a material that cannot be that small is left out at that size.
  std::vector<std::uint64_t> sizes = {56, 72, 96, 128, 192, 288, 432, 648, 972, 1458, 2187, 3280};
  /// Measures one evaluation of a material. The library has no clock of its own: a caller times batches on the machine that
  /// will render. Called once for each kind of table and number of lobes, from the calling thread.
  std::function<double(const Material&)> nanoseconds;
};

/// Makes files of several sizes, cuts each after every refinement to a file of its own, and measures what a decoder makes of
/// them at every level that differs. By ascending bytes; a point that another one beats or equals in bytes, error and time is left out. Throws like compress;
/// invalid_argument without a profile. Deterministic but for `nanoseconds`.
std::vector<TradePoint> measure_trade(const Measurement& m, const TradeOptions& options, const Progress& progress = {});

/// One alternative of an item that an allocation chooses for.
struct Alternative {
  double cost = 0;   ///< bytes, nanoseconds: what the budget limits; not negative
  double error = 0;  ///< what adds up over the items, times the item's weight; not negative
};

struct Allocation {
  std::vector<std::size_t> choice;  ///< of each item
  double cost = 0, error = 0;       ///< sums; the error is weighted
  /// Marginal error per cost at which the budget ended (the Lagrange multiplier); 0 where more would buy nothing.
  double price = 0;
};

/// Chooses one alternative per item so that the sum of weight * error is small and the sum of costs at most `budget`:
/// segments of the lower convex hulls by their slope (Shoham and Gersho 1988, Efficient bit allocation for an arbitrary set
/// of quantizers), which is optimal wherever the budget is used up by whole segments; then single steps and exchanges between
/// two items (the latter up to 2000 alternatives), off the hulls as well, as long as one lowers the error. Ties go to the earlier item and alternative. Throws Error: invalid_argument (no alternative,
/// other numbers of weights and items, what is negative or no number), target_not_met (its sentence says the smallest budget).
Allocation allocate(std::span<const std::vector<Alternative>> items, std::span<const double> weights, double budget);

}  // namespace brdf

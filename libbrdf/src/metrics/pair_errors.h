// SPDX-License-Identifier: Apache-2.0
// Errors over random pairs of directions.
#pragma once

#include "metrics/queries.h"

#include <brdf/metrics.h>

#include <span>

namespace brdf::metrics {

/// Errors of every pair, mean over channels.
struct PairErrors {
  std::vector<float> log_abs, cbrt_abs;
  std::vector<double> cbrt_square, cos_square;

  explicit PairErrors(std::size_t pairs) : log_abs(pairs), cbrt_abs(pairs), cbrt_square(pairs), cos_square(pairs) {}

  /// Compares `count` pairs from `first` on. `reference` and `candidate` hold f cos_i, not negative, one value per
  /// channel of those pairs.
  void compare(std::size_t first, std::size_t count, int channels, std::span<const float> reference,
               std::span<const float> candidate) noexcept;

  /// Fills log_mae, cbrt_rms and cos_l2.
  void summarize(const QuerySet& set, ErrorReport& report) const;
};

/// f -> max(f, 0) cos_i, in place, for rows of pairs.
void to_cosine_weighted(const QuerySet& set, std::size_t first_row, std::size_t count, int channels, float* f) noexcept;

/// Smallest value v such that the values at most v hold `share` of the total weight. Linear time; values and weights
/// have the same size, at least 1.
double weighted_quantile(std::span<const float> values, std::span<const double> weights, double share);

}  // namespace brdf::metrics

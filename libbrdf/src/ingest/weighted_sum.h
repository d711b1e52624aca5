// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace brdf::ingest {

/// A cell of a table and its share in an interpolated value.
struct WeightedCell {
  const float* values;  ///< one per channel
  double weight;
};

/// f[c] = sum of weight * values[c]. Sums stay in registers: adding into `f` itself would make every step wait for the
/// store of the one before.
inline void weighted_sum(std::span<const WeightedCell> cells, std::span<double> f) noexcept {
  if (f.size() == 3) {
    double r = 0, g = 0, b = 0;
    for (const auto& [values, weight] : cells) {
      r += weight * double{values[0]};
      g += weight * double{values[1]};
      b += weight * double{values[2]};
    }
    f[0] = r;
    f[1] = g;
    f[2] = b;
    return;
  }
  for (std::size_t c = 0; c < f.size(); ++c) {
    double sum = 0;
    for (const auto& [values, weight] : cells) sum += weight * double{values[c]};
    f[c] = sum;
  }
}

}  // namespace brdf::ingest

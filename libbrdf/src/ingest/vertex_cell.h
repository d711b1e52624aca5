// SPDX-License-Identifier: Apache-2.0
// Position on a row of samples.
#pragma once

#include <cstddef>

namespace brdf::ingest {

/// Left neighbour and the weight of the right one; left + 1 is a sample, too.
struct VertexCell {
  std::size_t left;
  double fraction;
};

/// Cell of position p on samples 0 .. count - 1 (count >= 2), clamped to the ends. NaN counts as 0, so that no input
/// can lead outside the table.
inline VertexCell vertex_cell(double p, std::size_t count) noexcept {
  const double last = static_cast<double>(count - 1);
  if (!(p > 0)) return {0, 0};
  if (p >= last) return {count - 2, 1};
  const auto left = static_cast<std::size_t>(p);
  return {left, p - static_cast<double>(left)};
}

}  // namespace brdf::ingest

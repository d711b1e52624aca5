// SPDX-License-Identifier: Apache-2.0
// A ResidualGrid in the form that evaluation reads: scales, byte strides and a pointer into the table.
#pragma once

#include "residual/residual_grid.h"

#include <cstddef>
#include <cstdint>

namespace brdf::eval {

struct GridParams {
  const std::uint16_t* ratio = nullptr;  ///< null: no grid
  float scale_h = 0, scale_d = 0, scale_p = 0;  ///< n - 1
  float last_h = 0, last_d = 0, last_p = 0;     ///< largest lower node, max(n - 2, 0)
  float nodes_d = 0, nodes_p = 0;               ///< n_d, n_p: node indices are below 2^24 and exact in float
  std::ptrdiff_t node_halves = 0;               ///< channels
  std::ptrdiff_t step_h = 0, step_d = 0, step_p = 0;  ///< halves to the upper node; 0 on an axis with one node
  // u = t (warp_a / (t + kappa) + warp_b)
  float kappa_h = 1, warp_a_h = 0, kappa_d = 1, warp_a_d = 0;
  float epsilon = 0;
  bool reciprocal = false;

  GridParams() = default;
  /// Checks the grid against its definition; an empty grid gives no table. Throws Error(invalid_argument) or
  /// Error(limit_exceeded). Keeps a pointer into `grid`.
  GridParams(const residual::ResidualGrid& grid, int channels);
};

}  // namespace brdf::eval

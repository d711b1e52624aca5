// SPDX-License-Identifier: Apache-2.0
// A ResidualGrid in the form that evaluation reads: scales, byte strides and a pointer into the table.
#pragma once

#include "residual/residual_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace brdf::eval {

struct GridParams {
  const std::uint16_t* ratio = nullptr;  ///< null: no grid
  float scale_p = 0;                            ///< n_p - 1
  float last_h = 0, last_d = 0, last_p = 0;     ///< largest lower node, max(n - 2, 0)
  float nodes_d = 0, nodes_p = 0;               ///< n_d, n_p: node indices are below 2^24 and exact in float
  std::ptrdiff_t node_halves = 0;               ///< channels
  std::ptrdiff_t step_h = 0, step_d = 0, step_p = 0;  ///< halves to the upper node; 0 on an axis with one node
  /// Position on an axis from t, the chord of its angle: x = scale u = t (linear + square t) / (t + kappa), which is the
  /// warp of residual/grid_coordinates.h with one quotient and nothing behind it.
  struct Axis {
    float kappa = 1, linear = 0, square = 0;
  };
  Axis axis_h, axis_d;
  float epsilon = 0;
  residual::Azimuth azimuth = residual::Azimuth::one_way;

  /// The three axes in lanes, for evaluation of one pair: position x = t (linear + square t) / (t + kappa) + offset.
  struct AxisLanes {
    struct Side {
      std::array<float, 4> linear, square, offset;
    };
    std::array<float, 4> kappa, last;
    std::array<Side, 2> side;            ///< see on_upper_side; the second one is the upper
    std::array<std::int32_t, 4> halves;  ///< from one node of the axis to the next; RGB only
  };
  alignas(64) AxisLanes lanes{};

  GridParams() = default;
  /// Checks the grid against its definition; an empty grid gives no table. Throws Error(invalid_argument) or
  /// Error(limit_exceeded). Keeps a pointer into `grid`.
  GridParams(const residual::ResidualGrid& grid, int channels);
};

}  // namespace brdf::eval

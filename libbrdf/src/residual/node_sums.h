// SPDX-License-Identifier: Apache-2.0
// Sums of the basis at the nodes of a table; the instruction set is chosen at run time. No fused operations and one order
// of summation, so every instruction set gives the same bits.
#pragma once

#include "residual/coefficient_order.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brdf::residual {

/// Floats of a row that vectors may read: the next multiple of 16.
constexpr std::size_t padded(std::size_t n) noexcept { return (n + 15) / 16 * 16; }

/// Coefficients of one channel and the values of the basis along each axis, in rows that start `stride` floats apart.
struct NodeSums {
  const std::vector<Frequency>& order;
  const std::vector<float>& value;                    ///< one per entry of the order
  std::size_t n_h, n_d, frequencies_d, harmonics;
  std::size_t stride_h, stride_d, stride_p;           ///< multiples of 16
  const float *cosine_h, *cosine_d, *cosine_p;        ///< [k][h], [l][d], [m][p]
  const float *window_h, *window_d;                   ///< [m][h], [m][d]
};

/// exp of the sums as half floats into [h][d][p], rows of p padded to stride_p.
void sum_nodes(const NodeSums& s, std::uint16_t* ratio);

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
// From coefficients to the table that evaluation reads.
#pragma once

#include "residual/channel_transform.h"
#include "residual/residual_code.h"
#include "residual/residual_grid.h"

#include <vector>

namespace brdf::residual {

/// Dequantised coefficients of some layers.
struct Coefficients {
  BasisCodes basis;
  SliceFrame slices;  ///< empty: half/difference coordinates
  Azimuth azimuth = Azimuth::one_way;
  int channels = 0;
  ChannelTransform transform = ChannelTransform::identity;
  std::vector<Frequency> order;
  std::vector<std::vector<float>> values;  ///< values[c][j] of transformed channel c at order[j]
};

/// Adds up the first `layers` layers of a code.
Coefficients dequantise(const ResidualCode& code, ChannelTransform transform, std::size_t layers);

/// Nodes of a grid.
struct GridSize {
  int n_h, n_d, n_p;  ///< n_p is for phi_d over [0, pi]; symmetric grids need half of it
};
/// Shapes of the balanced table, nearly equal in nodes; the encoder chooses. Part of the format: entries are only added.
inline constexpr GridSize balanced_grids[] = {{56, 28, 25}, {48, 40, 21}, {72, 32, 17}, {32, 44, 29}};
inline constexpr int balanced_grid_count = 4;
inline constexpr GridSize exact_grid{128, 64, 49};

/// Bytes of the table for a size.
std::size_t grid_bytes(const GridSize& size, Azimuth azimuth, int channels) noexcept;

/// Bytes that reconstruct takes at most beside its result.
std::size_t reconstruct_temporary_bytes(const Coefficients& c, const GridSize& size) noexcept;

/// Evaluates the basis on the nodes; `c` is in half/difference coordinates.
ResidualGrid reconstruct(const Coefficients& c, const GridSize& size);

}  // namespace brdf::residual

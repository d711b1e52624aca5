// SPDX-License-Identifier: Apache-2.0
// The tabulated density that directions are drawn from: marginal and conditional distributions by view.
#pragma once

#include "sample/height_warp.h"

#include <brdf/material.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace brdf::sample {

/// Most cells of a row.
inline constexpr std::size_t row_cells = 32;

/// A density that is linear in each of the equal cells of [0, 1], and its integral up to each edge. `node` begins where its third
/// value, the first that a search reads, is aligned to 32 bytes.
struct alignas(32) DensityRow {
  std::array<float, 6> unused{};
  std::array<float, 2 * row_cells + 2> node{};  ///< integral and density at each edge
};
static_assert(sizeof(DensityRow) == 288);

/// Integrals of a row up to every fourth edge inside; above all others: no edge.
struct alignas(32) QuarterRow {
  std::array<float, 8> integral{};
};

/// Rows in the order of a search, which first reads one of `quarters`. Those of all rows together stay in the fastest cache.
struct DensityRows {
  std::vector<QuarterRow> quarters;
  std::vector<DensityRow> rows;
};

/// Where the inverse of the warp begins in a cell of t: S about = lower + height f / (f + bend (1 - f)) at a share f of it,
/// which has the ends of the warp's inverse and its slope at the lower one.
struct alignas(16) WarpCell {
  float lower = 0, height = 0, bend = 1, unused = 0;
};

/// The density of directions whose half vectors with the view lie in lobes around the normal.
///
/// In the unit square of HalfVectorMap, with its heights S through a warp to t: bilinear in v between equal columns and t in
/// equal cells, linear in the view between nodes, each of integral 1, that crowd at the horizon and at the normal: equal
/// steps of a sqrt(cos theta_o) + (1 - a) (1 - sqrt(1 - cos theta_o)) up to 1, from first_view steps above 0. The integral of
/// an interpolated density is the interpolated integral, so sampling inverts exactly what pdf answers.
struct ComponentTable {
  static constexpr std::size_t views = 24, columns = 24, rows_per_view = columns + 1;
  static constexpr float first_view = 0.5f, horizon_share = 0.5f;  ///< the latter is a
  HeightWarp warp;
  std::array<WarpCell, row_cells> cell{};
  DensityRows marginal;     ///< over v, one per view
  DensityRows conditional;  ///< over t, rows_per_view per view
};

}  // namespace brdf::sample

namespace brdf {

/// What sampling reads beside evaluation's tables.
struct Material::Sampling {
  sample::ComponentTable front;
  std::optional<sample::ComponentTable> back;  ///< of the retro lobes, with the view turned by pi about the normal
  std::array<float, sample::ComponentTable::views> back_share{};
  std::size_t bytes() const noexcept;
};

}  // namespace brdf

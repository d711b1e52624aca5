// SPDX-License-Identifier: Apache-2.0
// One sample and one density from a single table, in scalars: a single call waits for one result after the other, and
// roots and quotients of scalars are there soonest. Steps and formulas are those of the blocks.
#include "sample/density.h"

#include <cmath>

#include "sample/density_kernel-inl.h"

#if defined(BRDF_SAMPLE_SINGLE_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_SINGLE_KERNEL_INL_H_
#undef BRDF_SAMPLE_SINGLE_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_SINGLE_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

using Map = HalfVectorMap<float>;

/// A view above the horizon: azimuth, map and place in the table.
struct SingleView {
  float e_x = 1, e_y = 0;
  Map map{0, 1};
  std::size_t view;
  float to_view;

  explicit HWY_INLINE SingleView(const Vec3f& wo) {
    const float s = std::sqrt(wo.x * wo.x + wo.y * wo.y);
    if (s > 1e-15f) {
      e_x = wo.x / s;
      e_y = wo.y / s;
    }
    map = Map(s, wo.z);
    constexpr float steps = static_cast<float>(Table::views - 1) + Table::first_view;
    constexpr float near_horizon = steps * Table::horizon_share, near_normal = steps - near_horizon;
    const float at = std::sqrt(map.c) * near_horizon - std::sqrt(std::max(1 - map.c, 0.0f)) * near_normal + (near_normal - Table::first_view);
    const float inside = std::max(at, 0.0f);
    view = std::min(static_cast<std::size_t>(inside), Table::views - 2);
    to_view = std::min(inside - static_cast<float>(view), 1.0f);
  }

  HWY_INLINE RowsOfPair<2> marginal(const Table& t) const {
    return {t.marginal, view, {1 - to_view, to_view}};
  }
  HWY_INLINE RowsOfPair<4> conditional(const Table& t, std::size_t column, float to_column) const {
    const float below = 1 - to_view;
    return {t.conditional, view * Table::rows_per_view + column,
            {below * (1 - to_column), below * to_column, to_view * (1 - to_column), to_view * to_column}};
  }
};

/// See inverse_integral of a vector.
HWY_INLINE float inverse_integral(float a, float e, float rise) {
  const float twice = rise + rise, root = std::sqrt(std::max(a * a + (e - a) * twice, 0.0f));
  return std::min(std::max(twice / (a + root), 0.0f), 1.0f);
}

template <std::size_t n>
HWY_INLINE std::size_t search(const RowsOfPair<n>& rows, float target) {
  return rows.cell(rows.quarter(target), target);
}

/// wi of (u, v) in [0, 1), and its density.
HWY_INLINE float draw_single(const Table& t, const Vec3f& wo, float u, float v, Vec3f& wi) {
  const SingleView w(wo);
  const float sided = u + u - 1, first = std::fabs(sided);
  float node[4];  // integral and density at either edge
  const RowsOfPair<2> marginal = w.marginal(t);
  const std::size_t column = search(marginal, first);
  marginal.store_node(column, node);
  constexpr auto columns = static_cast<float>(Table::columns);
  const float to_column = inverse_integral(node[1], node[3], (first - node[0]) * columns);
  const float target = v * ((1 - to_column) * node[1] + to_column * node[3]);
  const RowsOfPair<4> conditional = w.conditional(t, column, to_column);
  const std::size_t cell = search(conditional, target);
  conditional.store_node(cell, node);
  const float width = t.edge[cell + 1] - t.edge[cell];
  const float in_cell = inverse_integral(node[1] * width, node[3] * width, target - node[0]);
  Map::Half h = w.map.half_vector(std::min(t.edge[cell] + in_cell * width, 1.0f),
                                  (static_cast<float>(column) + to_column) * (1 / columns));
  if (sided < 0) h.y = -h.y;
  const float twice = h.wo_h + h.wo_h;
  wi = {twice * (h.x * w.e_x - h.y * w.e_y) - wo.x, twice * (h.x * w.e_y + h.y * w.e_x) - wo.y,
        std::max(twice * h.z - w.map.c, min_drawn_cosine)};
  return ((1 - in_cell) * node[1] + in_cell * node[3]) / (2 * h.area);
}

/// Density of draw_single at a pair above the horizon.
HWY_INLINE float pdf_single(const Table& t, const Vec3f& wi, const Vec3f& wo) {
  const SingleView w(wo);
  const float x = wi.x + wo.x, y = wi.y + wo.y;
  const Map::Point p = w.map.point(x * w.e_x + y * w.e_y, y * w.e_x - x * w.e_y, wi.z + w.map.c);
  const float at = p.v * static_cast<float>(Table::columns);
  const std::size_t column = std::min(static_cast<std::size_t>(at), Table::columns - 1);
  std::size_t cell = 0;
  for (std::size_t first = 1; first < row_cells; first += 8)
    cell += kernel::count_up_to(kernel::load_eight(t.edge.data() + first, 0.0f), std::min(p.height, below_one));
  float node[4];
  w.conditional(t, column, std::min(at - static_cast<float>(column), 1.0f)).store_node(cell, node);
  const float in_cell = std::min((p.height - t.edge[cell]) / (t.edge[cell + 1] - t.edge[cell]), 1.0f);
  return ((1 - in_cell) * node[1] + in_cell * node[3]) / (2 * p.area);
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

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

  /// Of the lower (0) or the upper (1) view.
  HWY_INLINE RowsOfPair<1> marginal(const Table& t, std::size_t upper) const { return {t.marginal, static_cast<std::int32_t>(view + upper), 0}; }
  HWY_INLINE RowsOfPair<2> conditional(const Table& t, std::size_t upper, std::size_t column, float to_column) const {
    return {t.conditional, static_cast<std::int32_t>((view + upper) * Table::rows_per_view + column), to_column};
  }
};

/// See inverse_integral of a vector.
HWY_INLINE float inverse_integral(float a, float e, float rise) {
  const float twice = rise + rise, root = std::sqrt(std::max(a * a + (e - a) * twice, 0.0f));
  return std::min(std::max(twice / (a + root), 0.0f), 1.0f);
}

/// See Warped; a lane for each of the terms.
struct SingleWarped {
  float t, slope, bend, third;
};

HWY_INLINE float sum_of(kernel::Float4 a) { return (a[0] + a[2]) + (a[1] + a[3]); }

HWY_INLINE SingleWarped warped(const HeightWarp& w, float y) {
  static_assert(HeightWarp::terms == 4);
  const kernel::Float4 width = kernel::load_four(w.width.data()), inverse = 1.0f / (y + width);
  const kernel::Float4 term = kernel::load_four(w.rise.data()) * inverse, part = term * (width * inverse), next = part * inverse;
  return {y * (w.line + sum_of(term)), w.line + sum_of(part), sum_of(next), sum_of(next * inverse)};
}

struct SingleUnwarped {
  float height, slope;
};

/// See the one of a vector.
HWY_INLINE SingleUnwarped unwarped(const Table& table, std::size_t cell, float in_cell) {
  const WarpCell& c = table.cell[cell];
  const float t = (static_cast<float>(cell) + in_cell) * (1.0f / static_cast<float>(row_cells));
  float y = c.lower + c.height * (in_cell / (in_cell + c.bend * (1 - in_cell))), slope = 1;
  for (int step = 0; step < table.warp.steps; ++step) {
    const SingleWarped at = warped(table.warp, y);
    const float rest = t - at.t, change = rest * at.slope / (at.slope * at.slope - rest * at.bend);
    const float next = std::min(std::max(y + change, c.lower), c.lower + c.height), moved = next - y;
    slope = at.slope + moved * (3 * at.third * moved - 2 * at.bend);
    y = next;
  }
  return {std::min(y, 1.0f), slope};
}

template <std::size_t n>
HWY_INLINE std::size_t search(const RowsOfPair<n>& rows, float target) {
  return rows.cell(rows.quarter(target), target);
}

/// Density at a place of a cell, from what is at its edges.
HWY_INLINE float density_in_cell(const float (&node)[4], float in_cell) { return (1 - in_cell) * node[1] + in_cell * node[3]; }

/// wi of (u, v) in [0, 1), from the view that `choice` takes, and the density of both views together.
HWY_INLINE float draw_single(const Table& t, const Vec3f& wo, float choice, float u, float v, Vec3f& wi) {
  const SingleView w(wo);
  const std::size_t chosen = choice < w.to_view ? 1 : 0;
  const float sided = u + u - 1, first = std::fabs(sided);
  float node[4], other[4];  // integral and density at either edge
  const RowsOfPair<1> marginal = w.marginal(t, chosen);
  const std::size_t column = search(marginal, first);
  kernel::store_four(marginal.node(column), node);
  constexpr auto columns = static_cast<float>(Table::columns);
  const float to_column = inverse_integral(node[1], node[3], (first - node[0]) * columns);
  const float target = v * ((1 - to_column) * node[1] + to_column * node[3]);
  const RowsOfPair<2> conditional = w.conditional(t, chosen, column, to_column);
  const std::size_t cell = search(conditional, target);
  kernel::store_four(conditional.node(cell), node);
  kernel::store_four(w.conditional(t, 1 - chosen, column, to_column).node(cell), other);
  const float in_cell = inverse_integral(node[1], node[3], (target - node[0]) * static_cast<float>(row_cells));
  const SingleUnwarped at = unwarped(t, cell, in_cell);
  Map::Half h = w.map.half_vector(at.height, (static_cast<float>(column) + to_column) * (1 / columns));
  if (sided < 0) h.y = -h.y;
  const float twice = h.wo_h + h.wo_h;
  wi = {twice * (h.x * w.e_x - h.y * w.e_y) - wo.x, twice * (h.x * w.e_y + h.y * w.e_x) - wo.y,
        std::max(twice * h.z - w.map.c, min_drawn_cosine)};
  const float to_other = chosen == 1 ? 1 - w.to_view : w.to_view;
  return ((1 - to_other) * density_in_cell(node, in_cell) + to_other * density_in_cell(other, in_cell)) * at.slope / (2 * h.area);
}

/// Density of draw_single at a pair above the horizon.
HWY_INLINE float pdf_single(const Table& t, const Vec3f& wi, const Vec3f& wo) {
  const SingleView w(wo);
  const float x = wi.x + wo.x, y = wi.y + wo.y;
  const Map::Point p = w.map.point(x * w.e_x + y * w.e_y, y * w.e_x - x * w.e_y, wi.z + w.map.c);
  const float at = p.v * static_cast<float>(Table::columns);
  const std::size_t column = std::min(static_cast<std::size_t>(at), Table::columns - 1);
  const SingleWarped height = warped(t.warp, p.height);
  const float row = height.t * static_cast<float>(row_cells);
  const std::size_t cell = std::min(static_cast<std::size_t>(row), row_cells - 1);
  float node[4];
  const float to_column = std::min(at - static_cast<float>(column), 1.0f);
  kernel::store_four((1 - w.to_view) * w.conditional(t, 0, column, to_column).node(cell) + w.to_view * w.conditional(t, 1, column, to_column).node(cell), node);
  return density_in_cell(node, std::min(row - static_cast<float>(cell), 1.0f)) * height.slope / (2 * p.area);
}

/// Share of the second component for one view.
HWY_INLINE float back_share(const Material::Sampling& s, const Vec3f& wo) {
  const SingleView w(wo);
  return s.back_share[w.view] + w.to_view * (s.back_share[w.view + 1] - s.back_share[w.view]);
}

/// What retro lobes take for the view.
HWY_INLINE Vec3f turned(const Vec3f& wo) { return {-wo.x, -wo.y, wo.z}; }

HWY_INLINE float pdf_of_all(const Material::Sampling& s, const Vec3f& wi, const Vec3f& wo) {
  const float front = pdf_single(s.front, wi, wo);
  if (!s.back) return front;
  const float share = back_share(s, wo);
  return (1 - share) * front + share * pdf_single(*s.back, wi, turned(wo));
}

/// u in [0, 1)
HWY_INLINE float draw_of_all(const Material::Sampling& s, const Vec3f& wo, const Vec3f& u, Vec3f& wi) {
  if (!s.back) return draw_single(s.front, wo, u.x, u.y, u.z, wi);
  const float share = back_share(s, wo);
  if (u.x < share)
    draw_single(*s.back, turned(wo), u.x / share, u.y, u.z, wi);
  else
    draw_single(s.front, wo, (u.x - share) / (1 - share), u.y, u.z, wi);
  return pdf_of_all(s, wi, wo);
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

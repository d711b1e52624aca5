// SPDX-License-Identifier: Apache-2.0
// Search and look-up in the tables of sample/density.h for a block of pairs: what all share is computed for a vector of
// pairs at once, the tables are read pair by pair in whole rows.
#include "sample/density.h"

#include <cstring>

#include "sample/map_kernel-inl.h"

#if defined(BRDF_SAMPLE_DENSITY_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_DENSITY_KERNEL_INL_H_
#undef BRDF_SAMPLE_DENSITY_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_DENSITY_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {
using kernel::block_pairs;
using Table = ComponentTable;

/// Position among the views of a table.
HWY_INLINE kernel::CellPosition view_position(V cos_o) {
  constexpr float steps = static_cast<float>(Table::views - 1) + Table::first_view;
  constexpr float near_horizon = steps * Table::horizon_share, near_normal = steps - near_horizon;
  const V sine2 = hn::Max(hn::Sub(set(1.0f), cos_o), hn::Zero(Floats()));  // twice that of theta_o / 2
  const V at = hn::MulAdd(kernel::root(cos_o), set(near_horizon), hn::NegMulAdd(kernel::root(sine2), set(near_normal), set(near_normal - Table::first_view)));
  return kernel::cell_position(hn::Max(at, hn::Zero(Floats())), static_cast<int>(Table::views) - 2);
}

/// A height through the warp: t, and the first three derivatives as factors 1, -2 and 6 leave them.
struct Warped {
  V t, slope, bend, third;
};

HWY_INLINE Warped warped(const HeightWarp& w, V y) {
  V sum = set(w.line), slope = sum, bend = hn::Zero(Floats()), third = bend;
  for (std::size_t j = 0; j < HeightWarp::terms; ++j) {
    const V width = set(w.width[j]), inverse = kernel::quotient(set(1.0f), hn::Add(y, width));
    const V term = hn::Mul(set(w.rise[j]), inverse), part = hn::Mul(term, hn::Mul(width, inverse)), next = hn::Mul(part, inverse);
    sum = hn::Add(sum, term);
    slope = hn::Add(slope, part);
    bend = hn::Add(bend, next);
    third = hn::MulAdd(next, inverse, third);
  }
  return {hn::Mul(y, sum), slope, bend, third};
}

/// A height and dt / dy there.
struct Unwarped {
  V height, slope;
};

/// Of a share of a cell, whose WarpCell is given: Halley's steps from there.
HWY_INLINE Unwarped unwarped(const HeightWarp& w, V cell, V in_cell, V lower, V height, V bend) {
  const V one = set(1.0f), t = hn::Mul(hn::Add(cell, in_cell), set(1.0f / static_cast<float>(row_cells)));
  V y = hn::MulAdd(height, kernel::quotient(in_cell, hn::MulAdd(bend, hn::Sub(one, in_cell), in_cell)), lower);
  V slope = one;
  for (int step = 0; step < w.steps; ++step) {
    const Warped at = warped(w, y);
    const V rest = hn::Sub(t, at.t);
    const V change = kernel::quotient(hn::Mul(rest, at.slope), hn::NegMulAdd(rest, at.bend, hn::Mul(at.slope, at.slope)));
    const V next = hn::Min(hn::Max(hn::Add(y, change), lower), hn::Add(lower, height)), moved = hn::Sub(next, y);
    slope = hn::MulAdd(hn::MulSub(hn::Mul(set(3.0f), at.third), moved, hn::Add(at.bend, at.bend)), moved, at.slope);
    y = next;
  }
  return {hn::Min(y, one), slope};
}

/// A cell of the table for each pair, and what is found there.
struct CellBlock {
  HWY_ALIGN std::int32_t view[2][block_pairs];  ///< the two whose densities are mixed
  HWY_ALIGN float to_second[block_pairs];       ///< share of the second
  HWY_ALIGN std::int32_t row[2][block_pairs];   ///< conditional row of either, at the lower column
  HWY_ALIGN float to_column[block_pairs];
  HWY_ALIGN std::int32_t cell[block_pairs];
  HWY_ALIGN float in_cell[block_pairs], slope[block_pairs];  ///< place there, and the warp's slope
  HWY_ALIGN float node[4 * block_pairs];  ///< integral and density at either edge of the cell
  HWY_ALIGN float start[4 * block_pairs];  ///< WarpCell

  /// What vectors read behind the last pair must be numbers.
  HWY_INLINE void pad(std::size_t size, std::size_t vectors) {
    if (HWY_LIKELY(size == vectors)) return;
    for (std::size_t i = 4 * size; i < 4 * vectors; ++i) node[i] = 0;
    for (std::size_t i = 4 * size; i < 4 * vectors; ++i) start[i] = 1;
    for (std::size_t i = size; i < vectors; ++i) cell[i] = 0;
  }
};

/// The lower view is the first.
HWY_INLINE void place_views(CellBlock& b, std::size_t at, const kernel::CellPosition& view) {
  const Ints di;
  hn::Store(view.index, di, b.view[0] + at);
  hn::Store(hn::Add(view.index, hn::Set(di, 1)), di, b.view[1] + at);
  hn::Store(view.fraction, Floats(), b.to_second + at);
}

/// The rows around column `column` of both views, which are stored.
HWY_INLINE void place_rows(CellBlock& b, std::size_t at, VI column, V to_column) {
  const Ints di;
  const VI rows = hn::Set(di, static_cast<std::int32_t>(Table::rows_per_view));
  for (std::size_t k = 0; k < 2; ++k) hn::Store(hn::Add(hn::Mul(hn::Load(di, b.view[k] + at), rows), column), di, b.row[k] + at);
  hn::Store(to_column, Floats(), b.to_column + at);
}

/// The row of one view of the marginal table (n = 1), or two neighbours of the conditional one (n = 2), interpolated.
template <std::size_t n>
struct RowsOfPair {
  static constexpr std::size_t row_floats = sizeof(DensityRow) / sizeof(float);
  static constexpr std::size_t first_node = offsetof(DensityRow, node) / sizeof(float);
  static constexpr std::size_t quarter_floats = sizeof(QuarterRow) / sizeof(float);

  const float* quarters;
  const float* row;
  float to_next;

  HWY_INLINE RowsOfPair(const DensityRows& t, std::int32_t first, float next)
      : quarters(t.quarters[static_cast<std::size_t>(first)].integral.data()),
        row(t.rows[static_cast<std::size_t>(first)].unused.data()),
        to_next(next) {}

  HWY_INLINE kernel::EightFloats eight(const float* p, std::size_t stride) const {
    if constexpr (n == 1) return kernel::load_eight(p, 0.0f);
    return kernel::add_weighted_eight(kernel::weighted_eight(1.0f - to_next, p), to_next, p + stride);
  }
  /// Integral and density at either edge of a cell.
  HWY_INLINE auto node(std::size_t cell) const {
    const float* const p = row + first_node + 2 * cell;
    if constexpr (n == 1) return kernel::load_four(p);
    return (1.0f - to_next) * kernel::load_four(p) + to_next * kernel::load_four(p + row_floats);
  }
  /// The number of inner fourth edges whose integral is not above `target`.
  HWY_INLINE std::size_t quarter(float target) const { return kernel::count_up_to(eight(quarters, quarter_floats), target); }
  /// The last cell, of those from that edge on, whose lower edge's integral is not above `target`.
  HWY_INLINE std::size_t cell(std::size_t quarter, float target) const {
    return 4 * quarter + kernel::count_even_up_to(eight(row + first_node + 2 + 8 * quarter, row_floats), target);
  }
};

HWY_INLINE RowsOfPair<1> marginal_row(const Table& t, const CellBlock& b, std::size_t i) { return {t.marginal, b.view[0][i], 0}; }

/// Of view k of the two.
HWY_INLINE RowsOfPair<2> conditional_rows(const Table& t, const CellBlock& b, std::size_t k, std::size_t i) {
  return {t.conditional, b.row[k][i], b.to_column[i]};
}

/// Cells of `size` pairs that hold the integrals in `target`, and what is at their edges. Step by step for all: each step
/// of a pair waits for the one before, and the processor looks ahead over few pairs.
template <class Rows>
HWY_INLINE void search_rows(std::size_t size, const float* HWY_RESTRICT target, CellBlock& b, const Rows& rows) {
  for (std::size_t i = 0; i < size; ++i) b.cell[i] = static_cast<std::int32_t>(rows(i).quarter(target[i]));
  for (std::size_t i = 0; i < size; ++i)
    b.cell[i] = static_cast<std::int32_t>(rows(i).cell(static_cast<std::size_t>(b.cell[i]), target[i]));
  for (std::size_t i = 0; i < size; ++i) kernel::store_four(rows(i).node(static_cast<std::size_t>(b.cell[i])), b.node + 4 * i);
}

HWY_INLINE void read_start(const Table& t, CellBlock& b, std::size_t i) {
  std::memcpy(b.start + 4 * i, &t.cell[static_cast<std::size_t>(b.cell[i])], sizeof(WarpCell));
}

/// Position in a cell where the integral of a density from a to e has risen to `rise` (of a cell of width 1).
HWY_INLINE V inverse_integral(V a, V e, V rise) {
  const V zero = hn::Zero(Floats()), twice = hn::Add(rise, rise);
  const V root = kernel::root(hn::Max(hn::MulAdd(hn::Sub(e, a), twice, hn::Mul(a, a)), zero));
  return hn::Min(hn::Max(kernel::quotient(twice, hn::Add(a, root)), zero), set(1.0f));
}

/// (1 - f) a + f e: for positive a and e never negative.
HWY_INLINE V between(V a, V e, V f) { return hn::MulAdd(f, e, hn::Mul(hn::Sub(set(1.0f), f), a)); }

/// Density at `point`s; pass one of three, one vector.
HWY_INLINE void begin_density(const Table& t, V cos_o, const Point& p, CellBlock& b, std::size_t at) {
  const Floats d;
  const Ints di;
  const kernel::CellPosition view = view_position(cos_o);
  constexpr auto columns = static_cast<float>(Table::columns);
  const kernel::CellPosition column = kernel::cell_position(hn::Mul(p.v, set(columns)), static_cast<int>(Table::columns) - 1);
  place_views(b, at, view);
  place_rows(b, at, column.index, column.fraction);
  const Warped height = warped(t.warp, p.height);
  const kernel::CellPosition cell = kernel::cell_position(hn::Mul(height.t, set(static_cast<float>(row_cells))), static_cast<int>(row_cells) - 1);
  hn::Store(cell.index, di, b.cell + at);
  hn::Store(cell.fraction, d, b.in_cell + at);
  hn::Store(height.slope, d, b.slope + at);
}

/// Pass three: density in the unit square.
HWY_INLINE V finish_density(const CellBlock& b, std::size_t at) {
  const Floats d;
  V unused, left, unused_too, right;
  hn::LoadInterleaved4(d, b.node + 4 * at, unused, left, unused_too, right);
  return hn::Mul(between(left, right, hn::Load(d, b.in_cell + at)), hn::Load(d, b.slope + at));
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

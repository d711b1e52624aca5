// SPDX-License-Identifier: Apache-2.0
// Directions drawn from a material's tables for a block of views: the marginal distribution is inverted, then the
// conditional one, then the point of the unit square is mapped to a direction.
#include "sample/density.h"

#include <algorithm>
#include <cstring>

#include "sample/pdf_kernel-inl.h"

#if defined(BRDF_SAMPLE_DRAW_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_DRAW_KERNEL_INL_H_
#undef BRDF_SAMPLE_DRAW_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_DRAW_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

/// Directions of a block and their density, 0 for views that are not above the horizon.
struct Drawn {
  HWY_ALIGN float x[block_pairs], y[block_pairs], z[block_pairs], pdf[block_pairs];
  HWY_INLINE void store(std::size_t at, const Directions& wi, V density) {
    const Floats d;
    const auto found = hn::Gt(density, hn::Zero(d));
    hn::Store(hn::IfThenElseZero(found, wi.x), d, x + at);
    hn::Store(hn::IfThenElseZero(found, wi.y), d, y + at);
    hn::Store(hn::IfThenElseZero(found, wi.z), d, z + at);
    hn::Store(hn::IfThenElseZero(found, density), d, pdf + at);
  }
};

struct DrawBlock {
  CellBlock cells;
  HWY_ALIGN float x[block_pairs], y[block_pairs], z[block_pairs], s[block_pairs], e_x[block_pairs], e_y[block_pairs];
  HWY_ALIGN float turn[block_pairs], side[block_pairs], valid[block_pairs], v[block_pairs];
  HWY_ALIGN float target[block_pairs];  ///< integral at the point searched for
  HWY_ALIGN float random[block_pairs];  ///< of the second search
  HWY_ALIGN float choice[block_pairs];  ///< the first number, of which the choice between components took its part
  HWY_ALIGN float other[4 * block_pairs];  ///< what CellBlock::node is, of the view that was not chosen
};

HWY_INLINE hn::Mask<Floats> above_horizon(const Directions& wo) {
  const V norm2 = hn::MulAdd(wo.x, wo.x, hn::MulAdd(wo.y, wo.y, hn::Mul(wo.z, wo.z)));
  // as eval::max_norm2 has it for a pair of the same length
  return hn::And(hn::Gt(wo.z, hn::Zero(Floats())), hn::Lt(norm2, set(0.25f * eval::max_norm2)));
}

/// The density is a mixture of those of two views; the direction is drawn from one of them, which becomes the first.
HWY_INLINE void choose_view(const kernel::CellPosition& view, V choice, CellBlock& b, std::size_t at) {
  const Floats d;
  const Ints di;
  const auto upper = hn::Lt(choice, view.fraction);
  const VI one = hn::Set(di, 1), up = hn::IfThenElseZero(hn::RebindMask(di, upper), one);
  hn::Store(hn::Add(view.index, up), di, b.view[0] + at);
  hn::Store(hn::Sub(hn::Add(view.index, one), up), di, b.view[1] + at);
  hn::Store(hn::IfThenElse(upper, hn::Sub(set(1.0f), view.fraction), view.fraction), d, b.to_second + at);
}

/// Views and random numbers; one vector. The component is chosen already.
HWY_INLINE void begin_draw(const DirectionSpan& wo, const DirectionSpan& u, std::size_t at, std::size_t count, bool choose,
                           DrawBlock& b) {
  const Floats d;
  const V zero = hn::Zero(d), one = set(1.0f);
  const Directions given = kernel::load_directions(wo, at, count);
  const auto valid = above_horizon(given);
  const V turn = choose ? hn::Load(d, b.turn + at) : one;
  const Views w = views_of({hn::Mul(hn::IfThenElseZero(valid, given.x), turn), hn::Mul(hn::IfThenElseZero(valid, given.y), turn),
                            hn::IfThenElse(valid, given.z, one)});
  choose_view(view_position(w.wo.z), choose ? hn::Load(d, b.choice + at) : into_unit_interval(kernel::load_first(u.x + at, count)), b.cells, at);
  hn::Store(w.wo.x, d, b.x + at);
  hn::Store(w.wo.y, d, b.y + at);
  hn::Store(w.wo.z, d, b.z + at);
  hn::Store(w.s, d, b.s + at);
  hn::Store(w.e_x, d, b.e_x + at);
  hn::Store(w.e_y, d, b.e_y + at);
  hn::Store(hn::IfThenElseZero(valid, one), d, b.valid + at);
  // both sides of the plane of wo begin at u = 1/2, where they join
  const V u_v = into_unit_interval(kernel::load_first(u.y + at, count)), sided = hn::Sub(hn::Add(u_v, u_v), one);
  hn::Store(hn::IfThenElse(hn::Lt(sided, zero), set(-1.0f), one), d, b.side + at);
  hn::Store(hn::Abs(sided), d, b.target + at);
  hn::Store(into_unit_interval(kernel::load_first(u.z + at, count)), d, b.random + at);
}

/// Components by the first random number: b.turn, and what is left of that number: b.choice.
HWY_INLINE void choose_components(const Material::Sampling& s, const DirectionSpan& wo, const DirectionSpan& u, DrawBlock& b) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t at = 0; at < wo.size; at += lanes) {
    const std::size_t count = HWY_MIN(lanes, wo.size - at);
    const Directions given = kernel::load_directions(wo, at, count);
    const kernel::CellPosition view =
        view_position(hn::Max(hn::IfThenElse(above_horizon(given), given.z, set(1.0f)), set(min_view_cosine)));
    place_views(b.cells, at, view);
    hn::Store(into_unit_interval(kernel::load_first(u.x + at, count)), d, b.choice + at);
  }
  for (std::size_t i = 0; i < wo.size; ++i) {
    const float share = back_share(s, b.cells, i), u_x = b.choice[i];
    const bool back = u_x < share;
    b.turn[i] = back ? -1.0f : 1.0f;
    b.choice[i] = back ? u_x / share : (u_x - share) / (1.0f - share);
  }
}

/// The first inverse: v of the unit square.
HWY_INLINE void invert_marginal(DrawBlock& b, std::size_t at) {
  const Floats d;
  constexpr auto columns = static_cast<float>(Table::columns);
  V before, left, after, right;
  hn::LoadInterleaved4(d, b.cells.node + 4 * at, before, left, after, right);
  const V rise = hn::Mul(hn::Sub(hn::Load(d, b.target + at), before), set(columns));
  const V to_column = inverse_integral(left, right, rise);
  const VI cell = hn::Load(Ints(), b.cells.cell + at);
  const V column = hn::ConvertTo(d, cell);
  place_rows(b.cells, at, cell, to_column);
  hn::Store(hn::Mul(hn::Add(column, to_column), set(1.0f / columns)), d, b.v + at);
  hn::Store(hn::Mul(hn::Load(d, b.random + at), between(left, right, to_column)), d, b.target + at);
}

/// The second inverse, S, and the direction.
HWY_INLINE void finish_draw(const Material::Sampling& tables, const DrawBlock& b, std::size_t at, Drawn& out) {
  const Floats d;
  const V one = set(1.0f);
  V before, left, after, right, lower, height, bend, unused;
  hn::LoadInterleaved4(d, b.cells.node + 4 * at, before, left, after, right);
  hn::LoadInterleaved4(d, b.cells.start + 4 * at, lower, height, bend, unused);
  V before_other, left_other, after_other, right_other;
  hn::LoadInterleaved4(d, b.other + 4 * at, before_other, left_other, after_other, right_other);
  const V in_cell = inverse_integral(left, right, hn::Mul(hn::Sub(hn::Load(d, b.target + at), before), set(static_cast<float>(row_cells))));
  const V cell = hn::ConvertTo(d, hn::Load(Ints(), b.cells.cell + at));
  Unwarped s = unwarped(tables.front.warp, cell, in_cell, lower, height, bend);
  if (tables.back) {
    const Unwarped back = unwarped(tables.back->warp, cell, in_cell, lower, height, bend);
    const auto chosen = hn::Lt(hn::Load(d, b.turn + at), hn::Zero(d));
    s = {hn::IfThenElse(chosen, back.height, s.height), hn::IfThenElse(chosen, back.slope, s.slope)};
  }
  const V v = hn::Load(d, b.v + at);
  const auto near = hn::Le(v, set(0.5f));
  const Views w{{hn::Load(d, b.x + at), hn::Load(d, b.y + at), hn::Load(d, b.z + at)},
                hn::Load(d, b.s + at), hn::Load(d, b.e_x + at), hn::Load(d, b.e_y + at)};
  const Mapped m = mapped_direction(w, s.height, {hn::IfThenElse(near, v, hn::Sub(one, v)), near}, hn::Load(d, b.side + at));
  const auto valid = hn::Gt(hn::Load(d, b.valid + at), hn::Zero(d));
  const V density = between(between(left, right, in_cell), between(left_other, right_other, in_cell), hn::Load(d, b.cells.to_second + at));
  out.store(at, m.wi, hn::IfThenElseZero(valid, hn::Mul(m.density, hn::Mul(density, s.slope))));
}

HWY_INLINE void draw_cosine(const DirectionSpan& wo, const DirectionSpan& u, Drawn& out) {
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t at = 0; at < wo.size; at += lanes) {
    const std::size_t count = HWY_MIN(lanes, wo.size - at);
    const Directions wi = cosine_directions(into_unit_interval(kernel::load_first(u.y + at, count)),
                                            into_unit_interval(kernel::load_first(u.z + at, count)));
    out.store(at, wi, hn::IfThenElseZero(above_horizon(kernel::load_directions(wo, at, count)), cosine_density(wi.z)));
  }
}

/// At most block_pairs directions.
HWY_INLINE void draw_block(const Material::Sampling* s, const DirectionSpan& wo, const DirectionSpan& u, Drawn& out) {
  if (s == nullptr) return draw_cosine(wo, u, out);
  DrawBlock b;
  const std::size_t size = wo.size, lanes = hn::Lanes(Floats()), vectors = (size + lanes - 1) / lanes * lanes;
  const bool choose = s->back.has_value();
  if (choose) {
    choose_components(*s, wo, u, b);
    std::fill(b.turn + size, b.turn + vectors, 1.0f);
    std::fill(b.choice + size, b.choice + vectors, 0.0f);
  }
  for (std::size_t at = 0; at < size; at += lanes) begin_draw(wo, u, at, HWY_MIN(lanes, size - at), choose, b);
  b.cells.pad(size, vectors);
  std::fill(b.other + 4 * size, b.other + 4 * vectors, 0.0f);
  const auto invert = [&](const auto& table) HWY_ATTR __attribute__((always_inline)) {
    search_rows(size, b.target, b.cells, [&](std::size_t i) HWY_ATTR { return marginal_row(table(i), b.cells, i); });
    for (std::size_t at = 0; at < size; at += lanes) invert_marginal(b, at);
    search_rows(size, b.target, b.cells, [&](std::size_t i) HWY_ATTR { return conditional_rows(table(i), b.cells, 0, i); });
    for (std::size_t i = 0; i < size; ++i) {
      kernel::store_four(conditional_rows(table(i), b.cells, 1, i).node(static_cast<std::size_t>(b.cells.cell[i])), b.other + 4 * i);
      read_start(table(i), b.cells, i);
    }
  };
  if (choose)
    invert([&](std::size_t i) -> const Table& { return b.turn[i] < 0 ? *s->back : s->front; });
  else
    invert([front = &s->front](std::size_t) -> const Table& { return *front; });
  for (std::size_t at = 0; at < size; at += lanes) finish_draw(*s, b, at, out);
  if (!choose) return;
  // the density of both components together, at the directions as they are returned
  PdfBlock both;
  HWY_ALIGN float pdf[block_pairs];
  block_pdf(s, {out.x, out.y, out.z, size}, wo, both, pdf);
  std::memcpy(out.pdf, pdf, size * sizeof(float));
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

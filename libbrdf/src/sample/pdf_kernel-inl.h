// SPDX-License-Identifier: Apache-2.0
// The density of a material's samples for a block of pairs.
#include "sample/density.h"

#include "sample/density_kernel-inl.h"

#if defined(BRDF_SAMPLE_PDF_KERNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BRDF_SAMPLE_PDF_KERNEL_INL_H_
#undef BRDF_SAMPLE_PDF_KERNEL_INL_H_
#else
#define BRDF_SAMPLE_PDF_KERNEL_INL_H_
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

struct PdfBlock {
  CellBlock cells;
  HWY_ALIGN float density[block_pairs];
};

/// `part` of a batch from `first` on.
HWY_INLINE DirectionSpan part_of(const DirectionSpan& w, std::size_t first, std::size_t size) {
  return {w.x + first, w.y + first, w.z + first, size};
}

/// One vector of pairs; those that are not valid look along the normal.
HWY_INLINE kernel::PairVectors valid_pairs(const DirectionSpan& wi, const DirectionSpan& wo, std::size_t at, std::size_t count) {
  kernel::PairVectors p = kernel::pair_vectors(kernel::load_directions(wi, at, count), kernel::load_directions(wo, at, count));
  const auto valid = p.valid;
  const auto or_normal = [&valid](const Directions& w) HWY_ATTR {
    return Directions{hn::IfThenElseZero(valid, w.x), hn::IfThenElseZero(valid, w.y), hn::IfThenElse(valid, w.z, set(1.0f))};
  };
  p.wi = or_normal(p.wi);
  p.wo = or_normal(p.wo);
  return p;
}

/// Density of one component at at most block_pairs pairs; 0 for those that are not valid. turn: -1 for retro lobes.
HWY_INLINE void component_pdf(const Table& t, float turn, const DirectionSpan& wi, const DirectionSpan& wo, PdfBlock& b,
                              float* HWY_RESTRICT pdf) {
  const Floats d;
  const std::size_t size = wi.size, lanes = hn::Lanes(d), vectors = (size + lanes - 1) / lanes * lanes;
  for (std::size_t at = 0; at < size; at += lanes) {
    const kernel::PairVectors p = valid_pairs(wi, wo, at, HWY_MIN(lanes, size - at));
    const Views w = views_of({hn::Mul(p.wo.x, set(turn)), hn::Mul(p.wo.y, set(turn)), p.wo.z});
    const Point point = mapped_point(w, p.wi);
    begin_density(t, w.wo.z, point, b.cells, at);
    hn::Store(hn::IfThenElseZero(p.valid, point.density), d, b.density + at);
  }
  b.cells.pad(size, vectors);
  for (std::size_t i = 0; i < size; ++i) {
    const auto cell = static_cast<std::size_t>(b.cells.cell[i]);
    const float up = b.cells.to_second[i];
    kernel::store_four((1.0f - up) * conditional_rows(t, b.cells, 0, i).node(cell) + up * conditional_rows(t, b.cells, 1, i).node(cell),
                       b.cells.node + 4 * i);
  }
  for (std::size_t at = 0; at < size; at += lanes) {
    const V density = hn::Load(d, b.density + at), value = hn::Mul(density, finish_density(b.cells, at));
    kernel::store_first(hn::IfThenElseZero(hn::Gt(density, hn::Zero(d)), value), pdf + at, HWY_MIN(lanes, size - at));
  }
}

/// Share of the second component for pair i, whose view is placed.
HWY_INLINE float back_share(const Material::Sampling& s, const CellBlock& b, std::size_t i) {
  const float first = s.back_share[static_cast<std::size_t>(b.view[0][i])], second = s.back_share[static_cast<std::size_t>(b.view[1][i])];
  return first + b.to_second[i] * (second - first);
}

/// Density of the samples at at most block_pairs pairs.
HWY_INLINE void block_pdf(const Material::Sampling* s, const DirectionSpan& wi, const DirectionSpan& wo, PdfBlock& b,
                          float* HWY_RESTRICT pdf) {
  if (s == nullptr) {
    const std::size_t lanes = hn::Lanes(Floats());
    for (std::size_t at = 0; at < wi.size; at += lanes) {
      const std::size_t count = HWY_MIN(lanes, wi.size - at);
      const kernel::PairVectors p = valid_pairs(wi, wo, at, count);
      kernel::store_first(hn::IfThenElseZero(p.valid, cosine_density(p.wi.z)), pdf + at, count);
    }
    return;
  }
  component_pdf(s->front, 1.0f, wi, wo, b, pdf);
  if (!s->back) return;
  HWY_ALIGN float back[block_pairs];
  component_pdf(*s->back, -1.0f, wi, wo, b, back);
  for (std::size_t i = 0; i < wi.size; ++i) {
    const float share = back_share(*s, b.cells, i);
    pdf[i] = (1.0f - share) * pdf[i] + share * back[i];
  }
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard

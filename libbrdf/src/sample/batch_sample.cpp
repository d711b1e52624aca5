// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sample/batch_sample.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "sample/batch_sample.h"

#include <hwy/highway.h>

#include "sample/draw_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

void run_pdf(const Material::Sampling* s, const DirectionSpan& wi, const DirectionSpan& wo, float* pdf) {
  PdfBlock block;
  for (std::size_t first = 0; first < wi.size; first += block_pairs) {
    const std::size_t size = HWY_MIN(block_pairs, wi.size - first);
    block_pdf(s, part_of(wi, first, size), part_of(wo, first, size), block, pdf + first);
  }
}

/// Pairs that were drawn, and cos_i / pdf.
struct DrawnPairs {
  const Drawn& drawn;
  const DirectionSpan& wo;
  HWY_INLINE V operator()(std::size_t i, std::size_t count, kernel::PairVectors& p) const {
    const Floats d;
    const Directions wi{hn::Load(d, drawn.x + i), hn::Load(d, drawn.y + i), hn::Load(d, drawn.z + i)};
    p = kernel::pair_vectors(wi, kernel::load_directions(wo, i, count));
    const V pdf = hn::Load(d, drawn.pdf + i);
    return hn::IfThenElseZero(hn::Gt(pdf, hn::Zero(d)), hn::Div(wi.z, pdf));
  }
};

void run_draw(const Material::Sampling* s, const DirectionSpan& wo, const DirectionSpan& u, const MutableDirectionSpan& wi,
              float* pdf, const eval::Tables* t, PlanarSpan weight) {
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  Drawn drawn;
  for (std::size_t first = 0; first < wo.size; first += block_pairs) {
    const std::size_t size = HWY_MIN(block_pairs, wo.size - first);
    const DirectionSpan views = part_of(wo, first, size);
    draw_block(s, views, part_of(u, first, size), drawn);
    for (std::size_t at = 0; at < size; at += lanes) {
      const std::size_t count = HWY_MIN(lanes, size - at);
      kernel::store_first(hn::Load(d, drawn.x + at), wi.x + first + at, count);
      kernel::store_first(hn::Load(d, drawn.y + at), wi.y + first + at, count);
      kernel::store_first(hn::Load(d, drawn.z + at), wi.z + first + at, count);
      kernel::store_first(hn::Load(d, drawn.pdf + at), pdf + first + at, count);
    }
    if (t != nullptr) kernel::eval_pairs(*t, size, {weight.data + first, weight.stride}, DrawnPairs{drawn, views});
  }
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::sample {

HWY_EXPORT(run_pdf);
HWY_EXPORT(run_draw);

void pdf_batch(const Material::Sampling* s, DirectionSpan wi, DirectionSpan wo, float* pdf) noexcept {
  HWY_DYNAMIC_DISPATCH(run_pdf)(s, wi, wo, pdf);
}

void draw_batch(const Material::Sampling* s, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf) noexcept {
  HWY_DYNAMIC_DISPATCH(run_draw)(s, wo, u, wi, pdf, nullptr, {});
}

void sample_batch(const eval::Tables& t, const Material::Sampling* s, DirectionSpan wo, DirectionSpan u,
                  MutableDirectionSpan wi, float* pdf, PlanarSpan weight) noexcept {
  HWY_DYNAMIC_DISPATCH(run_draw)(s, wo, u, wi, pdf, &t, weight);
}

}  // namespace brdf::sample
#endif

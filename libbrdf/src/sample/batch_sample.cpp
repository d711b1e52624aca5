// SPDX-License-Identifier: Apache-2.0
#include "eval/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sample/batch_sample.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "sample/batch_sample.h"

#include <hwy/highway.h>

#include "sample/warp_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

void run_sample(const eval::Tables& t, const DirectionSpan& wo, const DirectionSpan& u, const MutableDirectionSpan& wi,
                float* pdf, PlanarSpan weight) {
  const V zero = hn::Zero(Floats());
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t i = 0; i < wo.size; i += lanes) {
    const std::size_t count = HWY_MIN(lanes, wo.size - i);
    const Directions view = kernel::load_directions(wo, i, count);
    const Directions drawn = mixture_directions(t, view, kernel::load_directions(u, i, count));
    // pdf of the pair as it is returned; it is 0 for a pair at or below the horizon
    const kernel::PairVectors pair = kernel::pair_vectors(drawn, view);
    const V density = kernel::mixture_density(t, pair);
    const auto found = hn::Gt(density, zero);
    const V scale = hn::IfThenElseZero(found, hn::Div(drawn.z, density));
    kernel::eval_pairs(t, pair, scale, {weight, i, count});
    kernel::store_first(hn::IfThenElseZero(found, density), pdf + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.x), wi.x + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.y), wi.y + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.z), wi.z + i, count);
  }
}

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::sample {

HWY_EXPORT(run_sample);

void sample_batch(const eval::Tables& t, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf,
                  PlanarSpan weight) noexcept {
  HWY_DYNAMIC_DISPATCH(run_sample)(t, wo, u, wi, pdf, weight);
}

}  // namespace brdf::sample
#endif

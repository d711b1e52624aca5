// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sample/batch_sample.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "sample/batch_sample.h"

#include <hwy/highway.h>

#include "sample/warp_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

/// Pairs that the mixture draws.
struct DrawnPairs {
  const eval::Tables& t;
  const DirectionSpan &wo, &u;
  const MutableDirectionSpan& wi;
  float* pdf;
  HWY_INLINE V operator()(std::size_t i, std::size_t count, kernel::PairVectors& p) const {
    const Directions view = kernel::load_directions(wo, i, count);
    const Directions drawn = mixture_directions(t, view, kernel::load_directions(u, i, count));
    // the density of the pair as it is returned; it is 0 for a pair at or below the horizon
    p = kernel::pair_vectors(drawn, view);
    const V density = kernel::mixture_density(t, p);
    const auto found = hn::Gt(density, hn::Zero(Floats()));
    kernel::store_first(hn::IfThenElseZero(found, density), pdf + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.x), wi.x + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.y), wi.y + i, count);
    kernel::store_first(hn::IfThenElseZero(found, drawn.z), wi.z + i, count);
    return hn::IfThenElseZero(found, hn::Div(drawn.z, density));
  }
};

void run_sample(const eval::Tables& t, const DirectionSpan& wo, const DirectionSpan& u, const MutableDirectionSpan& wi,
                float* pdf, PlanarSpan weight) {
  kernel::eval_pairs(t, wo.size, weight, DrawnPairs{t, wo, u, wi, pdf});
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

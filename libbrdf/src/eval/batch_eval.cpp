// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "eval/batch_eval.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "eval/batch_eval.h"

#include <brdf/material.h>

#include <hwy/highway.h>

#include "eval/eval_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

/// Pairs that the caller gives.
struct GivenPairs {
  DirectionSpan wi, wo;
  HWY_INLINE V operator()(std::size_t i, std::size_t count, PairVectors& p) const {
    p = pair_vectors(load_directions(wi, i, count), load_directions(wo, i, count));
    return set(1.0f);
  }
};

void run_eval(const Tables& t, const DirectionSpan& wi, const DirectionSpan& wo, PlanarSpan f) {
  eval_pairs(t, wi.size, f, GivenPairs{wi, wo});
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf {
namespace eval {

HWY_EXPORT(run_eval);

void eval_batch(const Tables& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept {
  HWY_DYNAMIC_DISPATCH(run_eval)(t, wi, wo, f);
}

}  // namespace eval

const char* simd_target() noexcept {
  // SupportedTargets holds one bit per usable instruction set, the best one lowest; HWY_TARGETS are those compiled.
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  const std::int64_t best = usable != 0 ? usable & -usable : HWY_STATIC_TARGET;
  return best == HWY_SCALAR || best == HWY_EMU128 ? "scalar" : hwy::TargetName(best);
}

}  // namespace brdf
#endif

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

/// Pairs that the caller gives, with their density on the way.
template <bool with_pdf>
struct GivenPairs {
  const Tables& t;
  DirectionSpan wi, wo;
  float* pdf;
  HWY_INLINE V operator()(std::size_t i, std::size_t count, PairVectors& p) const {
    p = pair_vectors(load_directions(wi, i, count), load_directions(wo, i, count));
    if constexpr (with_pdf) store_first(mixture_density(t, p), pdf + i, count);
    return set(1.0f);
  }
};

void run_eval(const Tables& t, const DirectionSpan& wi, const DirectionSpan& wo, PlanarSpan f) {
  eval_pairs(t, wi.size, f, GivenPairs<false>{t, wi, wo, nullptr});
}

void run_pdf(const Tables& t, const DirectionSpan& wi, const DirectionSpan& wo, float* pdf) {
  const std::size_t lanes = hn::Lanes(Floats());
  for (std::size_t i = 0; i < wi.size; i += lanes) {
    PairVectors p;
    GivenPairs<true>{t, wi, wo, pdf}(i, HWY_MIN(lanes, wi.size - i), p);
  }
}

void run_eval_pdf(const Tables& t, const DirectionSpan& wi, const DirectionSpan& wo, PlanarSpan f, float* pdf) {
  eval_pairs(t, wi.size, f, GivenPairs<true>{t, wi, wo, pdf});
}

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf {
namespace eval {

HWY_EXPORT(run_eval);
HWY_EXPORT(run_pdf);
HWY_EXPORT(run_eval_pdf);

void eval_batch(const Tables& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f) noexcept {
  HWY_DYNAMIC_DISPATCH(run_eval)(t, wi, wo, f);
}

void pdf_batch(const Tables& t, DirectionSpan wi, DirectionSpan wo, float* pdf) noexcept {
  HWY_DYNAMIC_DISPATCH(run_pdf)(t, wi, wo, pdf);
}

void eval_pdf_batch(const Tables& t, DirectionSpan wi, DirectionSpan wo, PlanarSpan f, float* pdf) noexcept {
  HWY_DYNAMIC_DISPATCH(run_eval_pdf)(t, wi, wo, f, pdf);
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

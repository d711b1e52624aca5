// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "eval/single_eval.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "eval/batch_eval.h"
#include "eval/scalar_eval.h"
#include "eval/single_eval.h"

#include <hwy/highway.h>

#if HWY_TARGET != HWY_SCALAR
#include "eval/single_kernel-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace brdf::eval::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
void run_single(const LobeParams& lobes, const GridParams& grid, const Vec3f& wi, const Vec3f& wo, float* rgb) {
  eval_scalar(lobes, grid, wi, wo, {rgb, 3});
}
#else
void run_single(const LobeParams& lobes, const GridParams& grid, const Vec3f& wi, const Vec3f& wo, float* rgb) {
  const PairTerms p = pair_terms(wi, wo);
  V4 f = hn::Zero(Four());
  if (p.valid) {
    f = lobes_of_pair(lobes, p);
    if (grid.ratio) {
      const V4 epsilon = four(grid.epsilon);
      f = hn::Max(hn::MulSub(hn::Add(f, epsilon), ratio_of_pair(grid, p), epsilon), hn::Zero(Four()));
    }
  }
  HWY_ALIGN float lanes[4];
  hn::Store(f, Four(), lanes);
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = lanes[c];
}
#endif

}  // namespace brdf::eval::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::eval {

HWY_EXPORT(run_single);

void eval_single(const Tables& t, const Vec3f& wi, const Vec3f& wo, std::span<float> f) noexcept {
  if (t.slices.values)
    eval_batch(t, {&wi.x, &wi.y, &wi.z, 1}, {&wo.x, &wo.y, &wo.z, 1}, {f.data(), 1});
  else if (t.lobes.channels == 3)
    HWY_DYNAMIC_DISPATCH(run_single)(t.lobes, t.grid, wi, wo, f.data());
  else
    eval_scalar(t.lobes, t.grid, wi, wo, f);
}

}  // namespace brdf::eval
#endif

// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sample/single_sample.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "eval/pair_terms.h"
#include "sample/batch_sample.h"
#include "sample/single_sample.h"

#include <hwy/highway.h>

#include "sample/single_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::sample::HWY_NAMESPACE {

float run_draw_single(const Material::Sampling& s, const Vec3f& wo, const Vec3f& u, Vec3f& wi) { return draw_of_all(s, wo, u, wi); }

float run_pdf_single(const Material::Sampling& s, const Vec3f& wi, const Vec3f& wo) { return pdf_of_all(s, wi, wo); }

}  // namespace brdf::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::sample {

HWY_EXPORT(run_draw_single);
HWY_EXPORT(run_pdf_single);

namespace {

/// Into [0, 1), NaN to 0.
float into_unit_interval(float u) noexcept { return std::min(std::max(0.0f, u), below_one); }

}  // namespace

float draw_single(const Material::Sampling* s, const Vec3f& wo, const Vec3f& u, Vec3f& wi) noexcept {
  float pdf = 0;
  if (s == nullptr) {
    draw_batch(s, {&wo.x, &wo.y, &wo.z, 1}, {&u.x, &u.y, &u.z, 1}, {&wi.x, &wi.y, &wi.z, 1}, &pdf);
    return pdf;
  }
  wi = {0, 0, 0};
  if (!(wo.z > 0.0f && wo.x * wo.x + wo.y * wo.y + wo.z * wo.z < 0.25f * eval::max_norm2)) return 0;
  return HWY_DYNAMIC_DISPATCH(run_draw_single)(*s, wo, {into_unit_interval(u.x), into_unit_interval(u.y), into_unit_interval(u.z)}, wi);
}

float pdf_single(const Material::Sampling* s, const Vec3f& wi, const Vec3f& wo) noexcept {
  float pdf = 0;
  if (s == nullptr)
    pdf_batch(s, {&wi.x, &wi.y, &wi.z, 1}, {&wo.x, &wo.y, &wo.z, 1}, &pdf);
  else if (eval::pair_terms(wi, wo).valid)
    pdf = HWY_DYNAMIC_DISPATCH(run_pdf_single)(*s, wi, wo);
  return pdf;
}

}  // namespace brdf::sample
#endif

// SPDX-License-Identifier: Apache-2.0
#include "sample/scalar_sample.h"

#include "eval/single_eval.h"
#include "eval/warp.h"

#include <algorithm>

namespace brdf::sample {

Vec3f mixture_direction(const eval::Tables& t, const Vec3f& wo, const Vec3f& u) noexcept {
  if (!(wo.z > 0.0f)) return {0, 0, 0};
  const float choice = eval::into_unit_interval(u.x);
  const float u1 = eval::into_unit_interval(u.y), u2 = eval::into_unit_interval(u.z);
  const eval::Mixture::Curve powers = eval::bernstein_powers(std::min(wo.z, 1.0f));
  float upto = 0;
  for (std::size_t k = 0; k < t.lobes.ggx.size(); ++k) {
    upto += eval::mixture_weight(t.mixture.lobe[k], powers);
    if (choice < upto) return eval::ggx_direction(t.lobes.ggx[k], wo, u1, u2);
  }
  return eval::cosine_direction(u1, u2);
}

Sample sample_scalar(const eval::Tables& t, const Vec3f& wo, const Vec3f& u, std::span<float> weight) noexcept {
  weight = weight.first(static_cast<std::size_t>(t.lobes.channels));
  Sample s;
  const Vec3f wi = mixture_direction(t, wo, u);
  const float pdf = wi.z > 0.0f ? eval::eval_pdf_single(t, wi, wo, weight) : 0.0f;
  if (!(pdf > 0.0f)) {
    std::fill(weight.begin(), weight.end(), 0.0f);
    return s;
  }
  s.wi = wi;
  s.pdf = pdf;
  s.flags = sample_reflection;
  const float scale = wi.z / pdf;
  for (float& w : weight) w *= scale;
  return s;
}

}  // namespace brdf::sample

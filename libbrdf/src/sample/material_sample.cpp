// SPDX-License-Identifier: Apache-2.0
#include "eval/batch_eval.h"
#include "eval/material_impl.h"
#include "eval/single_eval.h"
#include "sample/albedo.h"
#include "sample/batch_sample.h"
#include "sample/density.h"
#include "sample/single_sample.h"

#include <algorithm>

namespace brdf {

bool Material::sampling() const noexcept { return sampling_ != nullptr; }

std::uint64_t Material::sampling_bytes() const noexcept { return sampling_ ? sampling_->bytes() : 0; }

float Material::pdf(const Vec3f& wi, const Vec3f& wo) const noexcept {
  return sample::pdf_single(sampling_.get(), wi, wo);
}

float Material::eval_pdf(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept {
  eval(wi, wo, f);
  return pdf(wi, wo);
}

void Material::pdf(DirectionSpan wi, DirectionSpan wo, float* pdf) const noexcept {
  sample::pdf_batch(sampling_.get(), wi, wo, pdf);
}

void Material::eval_pdf(DirectionSpan wi, DirectionSpan wo, PlanarSpan f, float* pdf) const noexcept {
  eval(wi, wo, f);
  sample::pdf_batch(sampling_.get(), wi, wo, pdf);
}

// A reflector scatters radiance and importance alike, so the mode of transport changes nothing yet.

Sample Material::sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode) const noexcept {
  weight = weight.first(static_cast<std::size_t>(channels()));
  Sample s;
  s.pdf = sample::draw_single(sampling_.get(), wo, u, s.wi);
  if (!(s.pdf > 0.0f)) {
    std::fill(weight.begin(), weight.end(), 0.0f);
    return s;
  }
  s.flags = sample_reflection;
  eval::eval_single(impl_->tables, s.wi, wo, weight);
  const float scale = s.wi.z / s.pdf;
  for (float& w : weight) w *= scale;
  return s;
}

void Material::sample(DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf, PlanarSpan weight,
                      TransportMode) const noexcept {
  sample::sample_batch(impl_->tables, sampling_.get(), wo, u, wi, pdf, weight);
}

void Material::albedo(const Vec3f& wo, std::span<float> a) const noexcept {
  sample::albedo(impl_->tables, sampling_.get(), wo, a);
}

}  // namespace brdf

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

bool Material::sampling() const noexcept { return sampling_ != nullptr || impl_->model; }

std::uint64_t Material::sampling_bytes() const noexcept { return sampling_ ? sampling_->bytes() : 0; }

float Material::pdf(const Vec3f& wi, const Vec3f& wo) const noexcept {
  if (impl_->scatterer) return analytic::pdf(*impl_->scatterer, wi, wo);
  return sample::pdf_single(sampling_.get(), wi, wo);
}

float Material::eval_pdf(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept {
  eval(wi, wo, f);
  return pdf(wi, wo);
}

void Material::pdf(DirectionSpan wi, DirectionSpan wo, float* pdf) const noexcept {
  if (impl_->scatterer) return analytic::pdf(*impl_->scatterer, wi, wo, pdf);
  sample::pdf_batch(sampling_.get(), wi, wo, pdf);
}

void Material::eval_pdf(DirectionSpan wi, DirectionSpan wo, PlanarSpan f, float* out) const noexcept {
  eval(wi, wo, f);
  pdf(wi, wo, out);
}

// A reflector scatters radiance and importance alike: the mode of transport concerns what transmits.

Sample Material::sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) const noexcept {
  weight = weight.first(static_cast<std::size_t>(channels()));
  if (impl_->scatterer) return analytic::sample(*impl_->scatterer, wo, u, weight, mode);
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
                      TransportMode mode) const noexcept {
  if (impl_->scatterer) return analytic::sample(*impl_->scatterer, channels(), wo, u, wi, pdf, weight, mode);
  sample::sample_batch(impl_->tables, sampling_.get(), wo, u, wi, pdf, weight);
}

void Material::albedo(const Vec3f& wo, std::span<float> a) const noexcept {
  if (impl_->scatterer) return sample::albedo(*impl_->scatterer, wo, a.first(static_cast<std::size_t>(channels())));
  sample::albedo(impl_->tables, sampling_.get(), wo, a);
}

}  // namespace brdf

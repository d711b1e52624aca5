// SPDX-License-Identifier: Apache-2.0
#include "eval/material_impl.h"
#include "sample/albedo.h"
#include "sample/batch_sample.h"
#include "sample/scalar_sample.h"

namespace brdf {

// A reflector scatters radiance and importance alike, so the mode of transport changes nothing yet.

Sample Material::sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode) const noexcept {
  return sample::sample_scalar(impl_->tables, wo, u, weight);
}

void Material::sample(DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf, PlanarSpan weight,
                      TransportMode) const noexcept {
  sample::sample_batch(impl_->tables, wo, u, wi, pdf, weight);
}

void Material::albedo(const Vec3f& wo, std::span<float> a) const noexcept { sample::albedo(impl_->tables, wo, a); }

}  // namespace brdf

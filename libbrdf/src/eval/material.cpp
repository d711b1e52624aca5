// SPDX-License-Identifier: Apache-2.0
#include "eval/batch_eval.h"
#include "eval/material_impl.h"
#include "eval/single_eval.h"

#include <utility>

namespace brdf {

const char* to_string(EvalLevel level) noexcept {
  switch (level) {
    case EvalLevel::fast: return "fast";
    case EvalLevel::balanced: return "balanced";
    case EvalLevel::exact: return "exact";
  }
  return "unknown";
}

namespace eval {

std::shared_ptr<Material::Impl> make_impl(MaterialInfo info, LobeSet lobes, Residual residual, EvalLevel level) {
  auto impl = std::make_shared<Material::Impl>();
  impl->info = std::move(info);
  impl->lobes = std::move(lobes);
  impl->residual = std::move(residual);
  impl->level = level;
  impl->tables.lobes = LobeParams(impl->lobes);
  impl->tables.grid = GridParams(impl->residual.grid, impl->lobes.channels);
  if (impl->residual.slices) impl->tables.slices = impl->residual.slices->view();
  return impl;
}

}  // namespace eval

int Material::channels() const noexcept { return impl_->tables.lobes.channels; }
EvalLevel Material::level() const noexcept { return impl_->level; }
const MaterialInfo& Material::info() const noexcept { return impl_->info; }
const LobeSet& Material::lobes() const noexcept { return impl_->lobes; }

const AnalyticModel* Material::analytic() const noexcept { return impl_->model ? &*impl_->model : nullptr; }

std::uint32_t Material::scatter_flags() const noexcept {
  return impl_->scatterer ? analytic::flags_of(*impl_->scatterer) : static_cast<std::uint32_t>(sample_reflection);
}

std::uint64_t Material::resident_bytes() const noexcept {
  const eval::Tables& t = impl_->tables;
  return sizeof(eval::Tables) + (impl_->scatterer ? sizeof(analytic::Scatterer) : 0) + t.lobes.ggx.size() * sizeof(eval::GgxLobe) +
         (t.lobes.lambert.size() + t.lobes.f0.size()) * sizeof(float) +
         impl_->residual.grid.ratio.size() * sizeof(std::uint16_t) + (impl_->residual.slices ? impl_->residual.slices->bytes() : 0);
}

void Material::eval(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept {
  if (impl_->facets != nullptr) return impl_->facets->eval(wi, wo, f);
  eval::eval_single(impl_->tables, wi, wo, f);
}

void Material::eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept {
  if (impl_->facets != nullptr) return impl_->facets->eval(wi, wo, f);
  eval::eval_batch(impl_->tables, wi, wo, f);
}

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
#include "surface/surface.h"

#include "surface/measured_table.h"

#include <array>
#include <cmath>
#include <numbers>

namespace brdf::render {
namespace {

/// Of what is drawn by another material's density: where that is far too small, values of the table must still be found.
constexpr float cosine_share = 0.1f;

}  // namespace

Surface Surface::from_albedo(const Vec3f& albedo) {
  Surface s;
  s.kind_ = Kind::diffuse;
  s.flags_ = sample_reflection;
  s.diffuse_ = albedo * std::numbers::inv_pi_v<float>;
  return s;
}

Surface Surface::from_material(const Material& material) {
  Surface s;
  s.kind_ = Kind::material;
  s.draws_itself_ = true;
  s.flags_ = material.scatter_flags();
  s.material_ = std::make_shared<const Material>(material);
  s.rgb_ = ChannelsToRgb(material.info().channels);
  s.proposal_ = Proposal(material);
  return s;
}

Surface Surface::from_analytic(const AnalyticModel& model) {
  if (const auto* lambert = std::get_if<Lambert>(&model)) {
    (void)Material::from_analytic(model);  // says what is wrong with it
    if (lambert->albedo.size() == 3) return from_albedo({lambert->albedo[0], lambert->albedo[1], lambert->albedo[2]});
  }
  return from_material(Material::from_analytic(model));
}

Surface Surface::from_table(std::shared_ptr<const MeasuredTable> table) {
  Surface s;
  s.kind_ = Kind::table;
  s.flags_ = sample_reflection;
  s.proposal_ = Proposal(table->proxy(), cosine_share);
  s.table_ = std::move(table);
  return s;
}

Surface Surface::with_proposal(Proposal proposal) const {
  Surface s = *this;
  if ((flags_ & sample_delta) != 0) return s;
  s.draws_itself_ = false;
  s.proposal_ = std::move(proposal);
  return s;
}

Vec3f Surface::eval(const Vec3f& wi, const Vec3f& wo) const noexcept {
  switch (kind_) {
    case Kind::black: break;
    case Kind::diffuse: return wi.z > 0 && wo.z > 0 ? diffuse_ : Vec3f(0);
    case Kind::material: return eval_rgb(*material_, rgb_, wi, wo);
    case Kind::table: return table_->eval(wi, wo);
  }
  return Vec3f(0);
}

float Surface::pdf(const Vec3f& wi, const Vec3f& wo) const noexcept {
  return draws_itself_ ? material_->pdf(wi, wo) : proposal_.pdf(wi, wo);
}

SurfaceSample Surface::sample(const Vec3f& wo, const Vec3f& u, TransportMode mode) const noexcept {
  SurfaceSample result;
  if (kind_ == Kind::black) return result;
  if (draws_itself_) {
    std::array<float, MeasuredTable::max_channels> weight;
    const Sample s = material_->sample(wo, u, weight, mode);
    result.wi = s.wi;
    result.pdf = s.pdf;
    result.eta = s.eta;
    result.flags = s.flags;
    if (s.pdf > 0) result.weight = rgb_(std::span<const float>(weight).first(static_cast<std::size_t>(rgb_.channels())));
    return result;
  }
  result.wi = proposal_.sample(wo, u, result.pdf);
  if (!(result.pdf > 0)) return result;
  result.flags = sample_reflection;
  result.weight = eval(result.wi, wo) * (result.wi.z / result.pdf);
  return result;
}

}  // namespace brdf::render

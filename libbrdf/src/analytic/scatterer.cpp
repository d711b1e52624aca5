// SPDX-License-Identifier: Apache-2.0
#include "analytic/scatterer.h"

#include "analytic/model_check.h"

#include <brdf/limits.h>

#include <array>
#include <vector>

namespace brdf::analytic {

namespace {

std::vector<double> in_double(const std::vector<float>& values) { return {values.begin(), values.end()}; }

/// Weights of one sample, before they go to their planes. Models have been checked against this number of channels.
using Weights = std::array<float, DecodeLimits{}.max_channels>;

}  // namespace

std::shared_ptr<const Scatterer> make_scatterer(const AnalyticModel& model) {
  if (const auto* ggx = std::get_if<GgxReflector>(&model)) return std::make_shared<const Scatterer>(GgxScatter(*ggx));
  if (const auto* mirror = std::get_if<Mirror>(&model)) return std::make_shared<const Scatterer>(MirrorScatter(*mirror));
  if (const auto* glass = std::get_if<Dielectric>(&model)) return std::make_shared<const Scatterer>(DielectricScatter(*glass));
  return nullptr;
}

bool facets_say_f(const AnalyticModel& model) noexcept {
  const auto* ggx = std::get_if<GgxReflector>(&model);
  return ggx != nullptr && (ggx->alpha_x != ggx->alpha_y || ggx->multiple_scattering);
}

LobeSet equal_lobes(const AnalyticModel& model) {
  LobeSet set{channels_of(model), {}};
  if (const auto* diffuse = std::get_if<Lambert>(&model)) set.lobes.push_back({LobeKind::lambert, 1, 1, in_double(diffuse->albedo)});
  const auto* ggx = std::get_if<GgxReflector>(&model);
  if (ggx != nullptr && !facets_say_f(model))
    set.lobes.push_back({LobeKind::ggx, static_cast<double>(ggx->alpha_x), 1, in_double(ggx->f0)});
  return set;
}

float pdf(const Scatterer& s, const Vec3f& wi, const Vec3f& wo) noexcept {
  const auto* facets = std::get_if<GgxScatter>(&s);
  return facets != nullptr ? facets->pdf(wi, wo) : 0.0f;
}

void pdf(const Scatterer& s, DirectionSpan wi, DirectionSpan wo, float* out) noexcept {
  for (std::size_t k = 0; k < wi.size; ++k) out[k] = pdf(s, {wi.x[k], wi.y[k], wi.z[k]}, {wo.x[k], wo.y[k], wo.z[k]});
}

Sample sample(const Scatterer& s, const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) noexcept {
  if (const auto* facets = std::get_if<GgxScatter>(&s)) return facets->sample(wo, u, weight, mode);
  if (const auto* mirror = std::get_if<MirrorScatter>(&s)) return mirror->sample(wo, u, weight, mode);
  if (const auto* glass = std::get_if<DielectricScatter>(&s)) return glass->sample(wo, u, weight, mode);
  return {};
}

void sample(const Scatterer& s, int channels, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* out,
            PlanarSpan weight, TransportMode mode) noexcept {
  Weights room;
  const std::span<float> w = std::span(room).first(static_cast<std::size_t>(channels));
  for (std::size_t k = 0; k < wo.size; ++k) {
    const Sample drawn = sample(s, {wo.x[k], wo.y[k], wo.z[k]}, {u.x[k], u.y[k], u.z[k]}, w, mode);
    wi.x[k] = drawn.wi.x;
    wi.y[k] = drawn.wi.y;
    wi.z[k] = drawn.wi.z;
    out[k] = drawn.pdf;
    for (std::size_t c = 0; c < w.size(); ++c) weight.data[c * weight.stride + k] = w[c];
  }
}

std::uint32_t flags_of(const Scatterer& s) noexcept {
  return std::visit([](const auto& scatter) { return scatter.flags; }, s);
}

}  // namespace brdf::analytic

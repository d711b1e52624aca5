// SPDX-License-Identifier: Apache-2.0
// How an analytic model is sampled, and evaluated where its lobes do not say it.
#pragma once

#include "analytic/ggx_scatter.h"
#include "analytic/specular.h"

#include <brdf/analytic.h>
#include <brdf/lobes.h>

#include <memory>
#include <variant>

namespace brdf::analytic {

using Scatterer = std::variant<GgxScatter, MirrorScatter, DielectricScatter>;

/// Null for a Lambertian: its lobe says f, and whoever has no table draws by the cosine. `model` has passed check().
std::shared_ptr<const Scatterer> make_scatterer(const AnalyticModel& model);

/// The lobes that equal a model, so that the kernels of lobes evaluate it. Without any for a model of delta lobes, whose f is 0,
/// and for one whose f its GgxScatter says; see facets_say_f.
LobeSet equal_lobes(const AnalyticModel& model);

/// Two roughnesses, or further bounces.
bool facets_say_f(const AnalyticModel& model) noexcept;

float pdf(const Scatterer& s, const Vec3f& wi, const Vec3f& wo) noexcept;
void pdf(const Scatterer& s, DirectionSpan wi, DirectionSpan wo, float* pdf) noexcept;
Sample sample(const Scatterer& s, const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) noexcept;
/// `channels` values for each direction.
void sample(const Scatterer& s, int channels, DirectionSpan wo, DirectionSpan u, MutableDirectionSpan wi, float* pdf,
            PlanarSpan weight, TransportMode mode) noexcept;
std::uint32_t flags_of(const Scatterer& s) noexcept;

}  // namespace brdf::analytic

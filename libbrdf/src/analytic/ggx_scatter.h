// SPDX-License-Identifier: Apache-2.0
// Microfacet reflection with one or two roughnesses, evaluated and sampled by its visible normals.
#pragma once

#include <brdf/analytic.h>
#include <brdf/ggx_energy.h>
#include <brdf/material.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace brdf::analytic {

/// Directions are drawn by visible normals (Heitz 2018). Where the reflection would leave below the horizon, it is folded
/// up, z to -z: nothing is rejected, and the density is the sum of two closed forms, that of the direction and that of its
/// image below. The weight stays within [0, 1]. With multiple scattering a cosine lobe is mixed in, by the share of the light that
/// it carries.
class GgxScatter {
 public:
  explicit GgxScatter(const GgxReflector& m);
  static constexpr std::uint32_t flags = sample_reflection;

  void eval(const Vec3f& wi, const Vec3f& wo, std::span<float> f) const noexcept;
  void eval(DirectionSpan wi, DirectionSpan wo, PlanarSpan f) const noexcept;
  float pdf(const Vec3f& wi, const Vec3f& wo) const noexcept;
  Sample sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) const noexcept;

  /// Parts of a weight: each channel's is f0 * plain + white + compensation_color * further.
  struct Parts {
    double plain = 0, white = 0, further = 0;
    double of(double f0, double color) const noexcept { return f0 * plain + white + color * further; }
  };
  /// Draws from the facets alone and gives the weight of the facets alone; `further` is 0.
  Parts facet_weight(const Vec3f& wo, const Vec3f& u) const noexcept;
  /// The directional albedo of a channel, from the mean of facet_weight.
  double albedo(std::size_t channel, const Vec3f& wo, const Parts& facets) const noexcept;
  int channels() const noexcept { return static_cast<int>(f0_.size()); }

 private:
  struct Pair;
  /// What of f all channels share, without the cosine.
  Parts value(const Pair& p) const noexcept;
  double facet_density(const Pair& p) const noexcept;
  double density(const Pair& p) const noexcept;
  Vec3f draw_facet(const Vec3f& wo, double u1, double u2) const noexcept;
  /// Share of the samples that the cosine lobe gets.
  double cosine_share(double cos_o) const noexcept;

  double ax_, ay_, inv_ax_, inv_ay_, peak_;  ///< peak_: D at the normal
  std::vector<float> f0_;
  std::optional<GgxEnergy> energy_;
  std::vector<float> color_;  ///< of the further bounces, one per channel; 0 without
  double mean_fresnel_ = 0, mean_color_ = 0;  ///< over the channels
};

}  // namespace brdf::analytic

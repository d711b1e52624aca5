// SPDX-License-Identifier: Apache-2.0
// How directions are drawn at a surface, apart from what its values are.
#pragma once

#include <brdf/material.h>

#include <optional>

namespace brdf::render {

/// A density over the upper hemisphere of wi for a given wo: cosine-distributed, or that of a material, with a small share of
/// cosine mixed in where the material is not the one that is evaluated. Thread-safe, noexcept, never allocates.
class Proposal {
 public:
  /// cos / pi.
  Proposal() = default;
  /// The density of `material`, which must be prepared for sampling and have at most 1024 channels; `cosine_share` in [0, 1).
  explicit Proposal(Material material, float cosine_share = 0) : material_(std::move(material)), cosine_share_(cosine_share) {}

  /// pdf 0 with wo at or below the horizon, or wi below it.
  float pdf(const Vec3f& wi, const Vec3f& wo) const noexcept;
  Vec3f sample(const Vec3f& wo, Vec3f u, float& pdf) const noexcept;

  /// The same with the material's lobes alone; a cosine stays one. May allocate.
  Proposal of_lobes() const;

  const Material* material() const noexcept { return material_ ? &*material_ : nullptr; }
  float cosine_share() const noexcept { return cosine_share_; }

 private:
  std::optional<Material> material_;
  float cosine_share_ = 0;
};

/// Cosine-distributed direction by the concentric map of Shirley and Chiu (1997).
Vec3f cosine_direction(float u, float v) noexcept;

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Light from infinitely far away in all directions.
#pragma once

#include "image/image.h"
#include "light/piecewise_constant.h"

#include <glm/vec2.hpp>

namespace brdf::render {

/// Radiance by direction, as a latitude-longitude picture: +y is its top row, -z its middle column, +x right of it.
///
/// Radiance is bilinear between the centres of pixels, and directions are drawn with a density that is constant in each pixel and
/// proportional to the mean of the bilinear radiance there, times the solid angle. Immutable and thread-safe.
class Environment {
 public:
  /// The same radiance everywhere.
  explicit Environment(const Vec3f& radiance);
  /// `map` has values of at least 0 and at least 2 x 2 pixels; `turn` radians turn it about +y, from +z towards +x.
  Environment(Image map, float turn);

  Vec3f radiance(const Vec3f& direction) const noexcept;
  /// Density of `sample`, per solid angle.
  float pdf(const Vec3f& direction) const noexcept;
  Vec3f sample(const glm::vec2& u, float& pdf) const noexcept;

  /// Integral of the luminance over all directions.
  float power() const noexcept { return power_; }

 private:
  glm::vec2 place(const Vec3f& direction) const noexcept;

  Vec3f constant_{0};
  Image map_;
  float turn_ = 0, power_ = 0;
  PiecewiseConstant2D density_;
};

/// Direction at (u, v) of a latitude-longitude picture, and back; no turn.
Vec3f direction_at(const glm::vec2& uv) noexcept;
glm::vec2 place_of(const Vec3f& direction) noexcept;

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Light from infinitely far away in all directions.
#pragma once

#include "image/image.h"
#include "light/piecewise_constant.h"
#include "memory/large_pages.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

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

  /// Four pixels and a place between them.
  struct Patch {
    std::uint32_t upper_left = 0;  ///< pixel
    float s = 0, t = 0;            ///< from it to the right and down
  };

  /// Radiance from a direction, and the density per solid angle that `sample` has there. `patch` is that of the direction.
  Vec3f radiance(const Vec3f& direction, const Patch& patch, float& pdf) const noexcept;
  Patch patch(const Vec3f& direction) const noexcept;

  /// A direction is drawn in three steps, because each reads what the one before has found, far away in memory: the row of the
  /// picture, the place in that row, and what is there with the density of drawing it.
  PiecewiseConstant1D::Draw draw_row(float u) const noexcept;
  struct Draw {
    glm::vec2 at{0, 0};
    Patch patch;
  };
  Draw draw(const PiecewiseConstant1D::Draw& row, float u) const noexcept;
  Vec3f sample(const Draw& drawn, float& pdf, Vec3f& radiance) const noexcept;

  /// Bring to the caches what the next step will read.
  void prefetch(const PiecewiseConstant1D::Draw& row, float u) const noexcept {
    if (!pixels_.empty()) draws_.prefetch(row.cell, u);
  }
  void prefetch(const Patch& patch) const noexcept {
    if (pixels_.empty()) return;
    __builtin_prefetch(&pixels_[patch.upper_left]);
    __builtin_prefetch(&pixels_[patch.upper_left + stride_]);
  }

  /// Integral of the luminance over all directions.
  float power() const noexcept { return power_; }

 private:
  /// Side by side in memory, because they are read together.
  struct Pixel {
    Vec3f radiance{0};
    float density = 1;  ///< of `draws_` in this pixel
  };
  Patch patch_at(const glm::vec2& at) const noexcept;
  /// `density`: per unit of the picture's area.
  Vec3f radiance_in(const Patch& patch, float& density) const noexcept;

  Vec3f constant_{0};
  float width_ = 0, height_ = 0;
  std::uint32_t stride_ = 0;   ///< of rows
  std::vector<Pixel, LargePages<Pixel>> pixels_;  ///< with a border of what is beyond the seam and the poles; empty: the same everywhere
  float turn_ = 0, power_ = 0;
  PiecewiseConstant2D draws_;
};

}  // namespace brdf::render

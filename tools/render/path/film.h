// SPDX-License-Identifier: Apache-2.0
// Sums of samples per pixel.
#pragma once

#include "image/image.h"
#include "light/luminance.h"

#include <cstdint>
#include <vector>

namespace brdf::render {

/// Box filter: a sample counts for its own pixel alone, so pixels are independent of each other.
class Film {
 public:
  struct Pixel {
    Vec3d sum{0};
    double luminance2 = 0;  ///< sum of squared luminances
    std::uint32_t samples = 0;

    void add(const Vec3f& radiance) noexcept {
      sum += Vec3d(radiance);
      const double y = static_cast<double>(luminance(radiance));
      luminance2 += y * y;
      ++samples;
    }
  };

  Film() = default;
  Film(int width, int height) : width_(width), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  int width() const noexcept { return width_; }
  int height() const noexcept { return width_ > 0 ? static_cast<int>(pixels_.size() / static_cast<std::size_t>(width_)) : 0; }
  Pixel& at(int x, int y) noexcept { return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]; }
  const Pixel& at(int x, int y) const noexcept { return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]; }

  /// Means; black where nothing was sampled.
  Image image() const;
  /// Variance of each pixel's mean luminance as its samples estimate it, row by row; 0 with fewer than two samples.
  std::vector<double> variance() const;
  /// Of the pixel that has fewest and of all together.
  std::uint32_t fewest_samples() const noexcept;
  std::uint64_t samples() const noexcept;

 private:
  int width_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace brdf::render

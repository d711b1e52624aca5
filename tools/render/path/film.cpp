// SPDX-License-Identifier: Apache-2.0
#include "path/film.h"

#include <algorithm>

namespace brdf::render {

Image Film::image() const {
  Image image(width(), height());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel& p = pixels_[i];
    if (p.samples > 0) image.pixels[i] = Vec3f(p.sum / static_cast<double>(p.samples));
  }
  return image;
}

std::vector<double> Film::variance() const {
  std::vector<double> result(pixels_.size(), 0.0);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Pixel& p = pixels_[i];
    if (p.samples < 2) continue;
    const double n = p.samples, mean = (0.2126 * p.sum.x + 0.7152 * p.sum.y + 0.0722 * p.sum.z) / n;
    result[i] = std::max(0.0, p.luminance2 / n - mean * mean) / (n - 1);
  }
  return result;
}

std::uint32_t Film::fewest_samples() const noexcept {
  const auto fewest = std::min_element(pixels_.begin(), pixels_.end(), [](const Pixel& a, const Pixel& b) { return a.samples < b.samples; });
  return fewest == pixels_.end() ? 0 : fewest->samples;
}

std::uint64_t Film::samples() const noexcept {
  std::uint64_t sum = 0;
  for (const Pixel& p : pixels_) sum += p.samples;
  return sum;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Eight-bit sRGB pixels: what a screen or a PNG file shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace brdf::render {

using Rgb8 = std::array<std::uint8_t, 3>;

/// Encoded sRGB, rows from the top, three bytes a pixel without padding.
struct Raster {
  int width = 0, height = 0;
  std::vector<Rgb8> pixels;

  Raster() = default;
  Raster(int w, int h, Rgb8 fill = {0, 0, 0})
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  Rgb8& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
  const Rgb8& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
};

}  // namespace brdf::render

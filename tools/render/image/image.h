// SPDX-License-Identifier: Apache-2.0
// A picture in memory: linear RGB, rows from the top.
#pragma once

#include <brdf/direction.h>

#include <cstddef>
#include <vector>

namespace brdf::render {

/// Linear radiance with sRGB's primaries (ITU-R BT.709), not clipped: pixel (x, y) is at y * width + x, y = 0 on top.
struct Image {
  int width = 0, height = 0;
  std::vector<Vec3f> pixels;

  Image() = default;
  Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Vec3f(0)) {}
  Vec3f& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
  const Vec3f& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
};

}  // namespace brdf::render

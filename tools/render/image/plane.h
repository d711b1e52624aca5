// SPDX-License-Identifier: Apache-2.0
// One number per pixel, and the filters that image metrics are made of.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::render {

/// Rows from the top, as in Image.
struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float& at(int x, int y) { return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
  float at(int x, int y) const { return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
};

/// Arithmetic mean in double precision; 0 of none.
double mean(const Plane& plane);

/// Correlation with the product of two odd kernels, whose middle is the pixel. Beyond the border the nearest pixel counts.
Plane filtered(const Plane& plane, std::span<const float> horizontal, std::span<const float> vertical);

/// Throws Error invalid_argument with both sizes unless the pictures have the same and at least one pixel.
void check_same_size(const Image& reference, const Image& candidate);

}  // namespace brdf::render

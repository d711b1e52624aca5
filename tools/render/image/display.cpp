// SPDX-License-Identifier: Apache-2.0
#include "image/display.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>

namespace brdf::render {

Image exposed(const Image& image, float exposure_stops) {
  const float factor = std::exp2(exposure_stops);
  Image result = image;
  for (Vec3f& pixel : result.pixels) {
    for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] > 0 ? std::min(pixel[c] * factor, 1.0F) : 0.0F;
  }
  return result;
}

Image displayed(const Image& image, float exposure_stops) {
  Image result = exposed(image, exposure_stops);
  for (Vec3f& pixel : result.pixels) {
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(srgb_encode(static_cast<double>(pixel[c])));
  }
  return result;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "image/plane.h"

#include <brdf/error.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace brdf::render {

double mean(const Plane& plane) {
  if (plane.values.empty()) return 0;
  return std::accumulate(plane.values.begin(), plane.values.end(), 0.0) / static_cast<double>(plane.values.size());
}

Plane filtered(const Plane& plane, std::span<const float> horizontal, std::span<const float> vertical) {
  const int h_radius = static_cast<int>(horizontal.size() / 2), v_radius = static_cast<int>(vertical.size() / 2);
  const std::size_t width = static_cast<std::size_t>(plane.width);
  // Both passes run over whole rows with the tap outermost, which compilers turn into vector code.
  Plane rows(plane.width, plane.height);
  std::vector<float> padded(width + horizontal.size() - 1);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = -h_radius; x < plane.width + h_radius; ++x) {
      padded[static_cast<std::size_t>(x + h_radius)] = plane.at(std::clamp(x, 0, plane.width - 1), y);
    }
    float* const out = &rows.at(0, y);
    for (std::size_t tap = 0; tap < horizontal.size(); ++tap) {
      for (std::size_t x = 0; x < width; ++x) out[x] += horizontal[tap] * padded[x + tap];
    }
  }
  Plane result(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y) {
    float* const out = &result.at(0, y);
    for (int tap = -v_radius; tap <= v_radius; ++tap) {
      const float* const in = &rows.values[static_cast<std::size_t>(std::clamp(y + tap, 0, plane.height - 1)) * width];
      const float weight = vertical[static_cast<std::size_t>(tap + v_radius)];
      for (std::size_t x = 0; x < width; ++x) out[x] += weight * in[x];
    }
  }
  return result;
}

void check_same_size(const Image& reference, const Image& candidate) {
  const auto size = [](const Image& image) { return std::to_string(image.width) + " x " + std::to_string(image.height); };
  if (reference.pixels.empty()) throw Error(ErrorCode::invalid_argument, "the reference is a picture without pixels");
  if (reference.width != candidate.width || reference.height != candidate.height) {
    throw Error(ErrorCode::invalid_argument,
                "the reference has " + size(reference) + " pixels and the candidate " + size(candidate));
  }
}

}  // namespace brdf::render

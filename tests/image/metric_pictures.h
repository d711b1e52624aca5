// SPDX-License-Identifier: Apache-2.0
// Two pictures that differ in sharpness, colour, level and noise. tests/support/metric_pictures.py makes the same ones.
#pragma once

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace brdf::test {

inline constexpr int metric_width = 96, metric_height = 64;

/// Stripes, a step, a dark corner and a highlight of radiance 40: linear radiance.
inline Vec3d metric_radiance(double x, double y) {
  const double u = x / metric_width, v = y / metric_height;
  const double wave = 0.5 + 0.5 * std::sin(0.9 * x * u + 3 * v);
  const double level = u + v > 1 ? 0.6 : 0.08;
  const double highlight = 40 * std::exp(-((x - 70) * (x - 70) + (y - 20) * (y - 20)) / 8);
  return {level * (0.2 + wave) + highlight, level * (0.5 + 0.5 * v) + highlight,
          level * (1 - 0.8 * u * wave) + 0.5 * highlight};
}

struct MetricPictures {
  render::Image reference{metric_width, metric_height}, candidate{metric_width, metric_height};
};

inline MetricPictures metric_pictures() {
  MetricPictures pictures;
  std::uint32_t state = 1;
  for (int y = 0; y < metric_height; ++y) {
    for (int x = 0; x < metric_width; ++x) {
      pictures.reference.at(x, y) = Vec3f(metric_radiance(x, y));
      const Vec3d moved = metric_radiance(x + 0.4, y);
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525U + 1013904223U;
        const double noise = state / 4294967296.0 - 0.5;
        pictures.candidate.at(x, y)[c] = static_cast<float>(std::max(0.0, moved[c] * (0.9 + 0.05 * c + 0.2 * noise) + 0.01 * noise));
      }
    }
  }
  return pictures;
}

}  // namespace brdf::test

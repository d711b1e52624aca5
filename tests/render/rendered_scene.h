// SPDX-License-Identifier: Apache-2.0
// Scenes from text, and what their pictures say about themselves.
#pragma once

#include "path/render_scene.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brdf::render::test {

inline Scene scene_of(const std::string& text) { return load_scene(parse_scene(text, "scene.json")); }

inline RenderResult rendered(const Scene& scene, int spp, Sampling sampling = Sampling::mis, std::uint64_t seed = 1) {
  RenderOptions options;
  options.spp = spp;
  options.threads = 2;
  options.sampling = sampling;
  options.seed = seed;
  return render_scene(scene, options);
}

/// Luminance of a block of pixels, and its standard error as the samples estimate it.
struct Mean {
  double value = 0, error = 0;
};

inline Mean mean_of(const Film& film, int left, int top, int width, int height) {
  const Image image = film.image();
  const std::vector<double> variance = film.variance();
  Mean m;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      m.value += static_cast<double>(luminance(image.at(x, y)));
      m.error += variance[static_cast<std::size_t>(y * film.width() + x)];
    }
  }
  const double pixels = width * height;
  return {m.value / pixels, std::sqrt(m.error) / pixels};
}
inline Mean mean_of(const Film& film) { return mean_of(film, 0, 0, film.width(), film.height()); }

/// That a mean is `expected` within five standard errors, and that these are small enough to tell anything: at most `precision`
/// of the value.
inline void expect_mean(const Mean& m, double expected, double precision) {
  EXPECT_LE(m.error, precision * expected) << "too noisy to say anything";
  EXPECT_NEAR(m.value, expected, 5 * m.error + 2e-4 * expected);
}

}  // namespace brdf::render::test

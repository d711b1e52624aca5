// SPDX-License-Identifier: Apache-2.0
// Snell's window, and radiance on the other side of an interface.
#include "rendered_scene.h"

#include <numbers>

namespace brdf::render::test {
namespace {

constexpr double pi = std::numbers::pi, water = 1.333;

/// A camera under water looks straight up through the calm surface into a sky of radiance 1; the ground is black.
Scene under_water(double fov, int size) {
  std::string text = R"({"camera": {"position": [0, -1, 0], "target": [0, 0, 0], "up": [0, 0, 1], "fov": )";
  text += std::to_string(fov);
  text += R"(}, "film": {"width": )";
  text += std::to_string(size);
  text += R"(, "height": 1}, "path": {"max_depth": 8, "roulette_depth": 1024},
    "environment": {"type": "sky", "width": 512, "zenith": 1, "horizon": 1, "ground": 0}, "materials": {"water": {"type": "dielectric", "ior": 1.333}},
    "shapes": [{"type": "quad", "material": "water", "corner": [-500, 0, 500], "edge_u": [1000, 0, 0], "edge_v": [0, 0, -1000]}]})";
  return scene_of(text);
}

TEST(Refraction, SnellsWindowEndsAtTheCriticalAngle) {
  // One row of square pixels; the field of view is that of one pixel's height.
  constexpr int size = 600;
  const double half_width = std::tan(60 * pi / 180), fov = 2 * std::atan(half_width / size) * 180 / pi;
  const Image image = rendered(under_water(fov, size), 64).film.image();
  const auto angle = [&](int x) { return std::atan(std::abs((x + 0.5) / size * 2 - 1) * half_width) * 180 / pi; };
  const double critical = std::asin(1 / water) * 180 / pi, pixel = 0.35;
  for (int x = 0; x < size; ++x) {
    const float seen = image.at(x, 0).x;
    if (angle(x) > critical + pixel) {
      EXPECT_EQ(seen, 0) << "total reflection shows the black ground, at " << angle(x);
    } else if (angle(x) < critical - 3) {
      EXPECT_GT(seen, 0.5f) << "the sky is seen at " << angle(x);
    }
  }
  // where the picture turns black
  int edge = size / 2;
  while (edge < size && image.at(edge, 0).x > 0) ++edge;
  EXPECT_NEAR(angle(edge), critical, pixel);
}

TEST(Refraction, RadianceIsScaledByEtaSquared) {
  // Along the normal: n^2 (1 - F0) of the sky's radiance arrives.
  const double f0 = std::pow((water - 1) / (water + 1), 2);
  expect_mean(mean_of(rendered(under_water(0.01, 16), 4096).film), water * water * (1 - f0), 0.005);
}

TEST(Refraction, AGlassSphereTurnsThePictureRound) {
  // Lit from the left: the sphere shows the light at its right.
  const Scene scene = scene_of(R"({"camera": {"position": [0, 0, 8], "target": [0, 0, 0], "fov": 16}, "film": {"width": 16, "height": 16},
    "environment": {"type": "sky", "width": 128, "zenith": 0.01, "horizon": 0.01, "ground": 0.01, "lamps": [{"direction": [-0.7, 0, -1], "size": 40, "radiance": 5}]},
    "materials": {"glass": {"type": "dielectric", "ior": 1.5}}, "shapes": [{"type": "sphere", "material": "glass"}]})");
  const Film film = rendered(scene, 64).film;
  EXPECT_GT(mean_of(film, 8, 4, 6, 8).value, 5 * mean_of(film, 2, 4, 6, 8).value);
}

}  // namespace
}  // namespace brdf::render::test

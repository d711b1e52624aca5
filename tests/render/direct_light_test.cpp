// SPDX-License-Identifier: Apache-2.0
// Light on a diffuse floor against closed forms.
#include "rendered_scene.h"

#include <glm/geometric.hpp>
#include <numbers>

namespace brdf::render::test {
namespace {

constexpr double pi = std::numbers::pi;

/// A camera that sees a tiny spot of the floor around the origin, of albedo 0.5, and whatever else is given.
std::string floor_scene(const std::string& rest) {
  return R"({"camera": {"position": [0, 0.5, 6], "target": [0, 0, 0], "fov": 0.02}, "film": {"width": 8, "height": 8},
    "path": {"max_depth": 1}, "materials": {"grey": {"type": "lambert", "albedo": 0.5}, "black": {"type": "lambert", "albedo": 0}}, )" + rest;
}

/// The floor alone, under these lights.
Scene open_floor(std::string lights) {
  lights += R"(, "shapes": [{"type": "quad", "material": "grey", "corner": [-9, 0, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]}]})";
  return scene_of(floor_scene(lights));
}

/// Share of a small area's view that a rectangle a x b takes at height h over its corner, parallel to it (Howell's catalogue of
/// radiation configuration factors, B-3).
double corner_factor(double a, double b, double h) {
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * pi);
}

TEST(DirectLight, OfARectangularLampIsTheClosedForm) {
  const Scene scene = scene_of(floor_scene(
      R"("shapes": [{"type": "quad", "material": "grey", "corner": [-9, 0, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
                    {"type": "quad", "material": "black", "emission": 3, "corner": [-1, 2, -0.5], "edge_u": [2, 0, 0], "edge_v": [0, 0, 1]}]})"));
  const double expected = 0.5 * 3 * 4 * corner_factor(1, 0.5, 2);
  for (const Sampling s : {Sampling::mis, Sampling::light, Sampling::bsdf}) {
    SCOPED_TRACE(to_string(s));
    expect_mean(mean_of(rendered(scene, s == Sampling::bsdf ? 2048 : 512, s).film), expected, 0.01);
  }
}

TEST(DirectLight, ALampShinesToItsFrontAlone) {
  const Scene scene = scene_of(floor_scene(
      R"("shapes": [{"type": "quad", "material": "grey", "corner": [-9, 0, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
                    {"type": "quad", "material": "black", "emission": 3, "corner": [-1, 2, 0.5], "edge_u": [2, 0, 0], "edge_v": [0, 0, -1]}]})"));
  EXPECT_EQ(mean_of(rendered(scene, 16).film).value, 0);
}

TEST(DirectLight, OfADirectionalLightHasNoNoise) {
  const Scene scene = open_floor(R"("lights": [{"type": "directional", "direction": [1, -2, 0.5], "irradiance": [2, 2, 2]}])");
  const double cosine = 2 / std::sqrt(1 + 4 + 0.25);
  for (const Sampling s : {Sampling::mis, Sampling::light, Sampling::bsdf}) {
    const Mean m = mean_of(rendered(scene, 4, s).film);
    EXPECT_NEAR(m.value, 0.5 / pi * 2 * cosine, 1e-6) << to_string(s);
    EXPECT_NEAR(m.error, 0, 1e-6);
  }
}

TEST(DirectLight, ShadowsAreCast) {
  const Scene scene = scene_of(floor_scene(
      R"("lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": 1}],
         "shapes": [{"type": "quad", "material": "grey", "corner": [-9, 0, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
                    {"type": "sphere", "material": "black", "centre": [0, 3, 0], "radius": 0.5}]})"));
  EXPECT_EQ(mean_of(rendered(scene, 4).film).value, 0);
}

TEST(DirectLight, UnderAConstantSkyIsTheAlbedo) {
  const Scene scene = open_floor(R"("environment": {"type": "constant", "radiance": 2})");
  expect_mean(mean_of(rendered(scene, 512).film), 1, 0.005);
}

TEST(DirectLight, OfSeveralLightsAddsUp) {
  const Scene scene = open_floor(
      R"("environment": {"type": "constant", "radiance": 0.5}, "lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": 3},
         {"type": "directional", "direction": [1, -1, 0], "irradiance": 1}])");
  expect_mean(mean_of(rendered(scene, 2048).film), 0.5 / pi * (3 + std::sqrt(0.5)) + 0.25, 0.01);
}

}  // namespace
}  // namespace brdf::render::test

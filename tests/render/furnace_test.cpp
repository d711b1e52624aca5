// SPDX-License-Identifier: Apache-2.0
// In light that is 1 from everywhere, what reflects everything is invisible and nothing is brighter than 1.
#include "rendered_scene.h"

namespace brdf::render::test {
namespace {

/// A sphere of a material that fills most of the picture.
Scene furnace(const std::string& material, const std::string& path = R"({"max_depth": 1024, "roulette_depth": 1024})") {
  return scene_of(R"({"camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fov": 32}, "film": {"width": 16, "height": 16}, "path": )" + path +
                  R"(, "environment": {"type": "constant", "radiance": 1}, "materials": {"m": )" + material +
                  R"(}, "shapes": [{"type": "sphere", "material": "m"}]})");
}

/// Every pixel is 1 within five of its own standard errors and `tolerance`.
void expect_every_pixel(const Film& film, double tolerance) {
  const Image image = film.image();
  const std::vector<double> variance = film.variance();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(luminance(image.pixels[i])), 1, 5 * std::sqrt(variance[i]) + tolerance) << "pixel " << i;
  }
}

constexpr const char* white = R"({"type": "lambert", "albedo": 1})";
constexpr const char* gloss = R"({"type": "ggx", "alpha": 0.4, "f0": 1, "multiple_scattering": true})";

TEST(Furnace, WhiteLambertianIsInvisible) {
  // Directions drawn by the cosine have weight 1 each, so nothing is left to chance.
  expect_every_pixel(rendered(furnace(white), 4, Sampling::bsdf).film, 1e-5);
  expect_every_pixel(rendered(furnace(white), 256, Sampling::mis).film, 1e-3);
  expect_mean(mean_of(rendered(furnace(white), 256, Sampling::light).film), 1, 6e-3);
}

TEST(Furnace, MirrorAndGlassAreInvisible) {
  expect_every_pixel(rendered(furnace(R"({"type": "mirror", "reflectance": 1})"), 4).film, 1e-5);
  // Radiance is divided by eta squared on the way in and multiplied by it on the way out.
  expect_every_pixel(rendered(furnace(R"({"type": "dielectric", "ior": 1.5})"), 64).film, 1e-3);
  expect_every_pixel(rendered(furnace(R"({"type": "dielectric", "ior": 0.7})"), 64).film, 1e-3);
}

TEST(Furnace, RouletteChangesNoMean) {
  const Scene scene = furnace(R"({"type": "dielectric", "ior": 1.5})", R"({"max_depth": 1024, "roulette_depth": 1})");
  expect_mean(mean_of(rendered(scene, 512).film), 1, 2e-3);
}

TEST(Furnace, GlossyReflectorWithMultipleScatteringLosesNothing) {
  expect_mean(mean_of(rendered(furnace(gloss), 256).film), 1, 3e-3);
  expect_mean(mean_of(rendered(furnace(gloss), 256, Sampling::cosine).film), 1, 6e-3);
}

TEST(Furnace, NoPixelIsBrighterThanOne) {
  for (const char* material : {white, gloss, R"({"type": "ggx", "alpha": 0.05, "f0": 1})", R"({"type": "ggx", "alpha_x": 0.6, "alpha_y": 0.1, "f0": 0.9})"}) {
    SCOPED_TRACE(material);
    const Film film = rendered(furnace(material), 64).film;
    const Image image = film.image();
    const std::vector<double> variance = film.variance();
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      EXPECT_LE(static_cast<double>(luminance(image.pixels[i])), 1 + 5 * std::sqrt(variance[i]) + 2e-3);
    }
  }
}

TEST(Furnace, AlbedoOfAGreySphereIsWhatItSays) {
  const Film film = rendered(furnace(R"({"type": "lambert", "albedo": 0.25})"), 4, Sampling::bsdf).film;
  EXPECT_NEAR(mean_of(film, 6, 6, 4, 4).value, 0.25, 1e-5);
}

}  // namespace
}  // namespace brdf::render::test

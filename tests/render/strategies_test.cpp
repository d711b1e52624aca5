// SPDX-License-Identifier: Apache-2.0
// Every way of sampling has the same mean.
#include "rendered_scene.h"

namespace brdf::render::test {
namespace {

/// A lamp, a sky with a bright spot, diffuse and glossy things that see each other.
const char* const mixed_scene = R"({
  "camera": {"position": [0, 1.6, 5], "target": [0, 0.7, 0], "fov": 32}, "film": {"width": 24, "height": 16},
  "path": {"max_depth": 4, "roulette_depth": 2},
  "environment": {"type": "sky", "width": 64, "zenith": 0.4, "horizon": 0.7, "ground": 0.1, "lamps": [{"direction": [1, 1, 0.5], "size": 40, "radiance": 4}]},
  "materials": {"floor": {"type": "lambert", "albedo": [0.6, 0.5, 0.4]}, "lamp": {"type": "lambert", "albedo": 0.2},
                "gloss": {"type": "ggx", "alpha": 0.35, "f0": [0.9, 0.6, 0.4]}, "brushed": {"type": "ggx", "alpha_x": 0.6, "alpha_y": 0.25, "f0": 0.7}},
  "shapes": [
    {"type": "quad", "material": "floor", "corner": [-6, 0, 6], "edge_u": [12, 0, 0], "edge_v": [0, 0, -12]},
    {"type": "quad", "material": "lamp", "emission": 3, "corner": [-1.5, 2.6, -1], "edge_u": [3, 0, 0], "edge_v": [0, 0, 2]},
    {"type": "sphere", "material": "gloss", "centre": [-0.8, 0.7, 0], "radius": 0.7},
    {"type": "blob", "material": "brushed", "segments": 24, "amplitude": 0.1, "transform": [{"scale": 0.7}, {"translate": [0.9, 0.7, 0]}]}]})";

/// Blocks of 8 x 8 pixels of both pictures agree within five standard errors of their difference.
void expect_same(const Film& a, const Film& b) {
  for (int y = 0; y < a.height(); y += 8) {
    for (int x = 0; x < a.width(); x += 8) {
      const Mean p = mean_of(a, x, y, 8, 8), q = mean_of(b, x, y, 8, 8);
      const double error = std::hypot(p.error, q.error);
      EXPECT_LE(error, 0.03 * p.value) << "too noisy to say anything";
      EXPECT_NEAR(p.value, q.value, 5 * error) << "block at " << x << ", " << y;
    }
  }
}

TEST(Sampling, EveryStrategyHasTheSameMean) {
  const Scene scene = scene_of(mixed_scene);
  const Film reference = rendered(scene, 256, Sampling::mis, 1).film;
  for (const Sampling s : {Sampling::light, Sampling::bsdf, Sampling::cosine, Sampling::lobes}) {
    SCOPED_TRACE(to_string(s));
    expect_same(reference, rendered(scene, 384, s, 2).film);
  }
}

TEST(Sampling, CombiningStrategiesIsNotWorseThanTheBetterOfThemByMuch) {
  const Scene scene = scene_of(mixed_scene);
  const double mis = mean_of(rendered(scene, 128).film).error, light = mean_of(rendered(scene, 128, Sampling::light).film).error,
               bsdf = mean_of(rendered(scene, 128, Sampling::bsdf).film).error;
  EXPECT_LT(mis, 1.1 * std::min(light, bsdf));
}

TEST(Sampling, AnotherProposalChangesNoMean) {
  const Scene scene = scene_of(mixed_scene);
  std::vector<Surface> exchanged = surfaces_for(scene, Sampling::mis);
  const std::uint32_t gloss = scene.slot("gloss"), floor = scene.slot("floor");
  exchanged[floor] = exchanged[floor].with_proposal(Proposal(*scene.materials[gloss].surface.proposal().material(), 0.3f));
  RenderOptions options;
  options.spp = 384;
  options.seed = 3;
  expect_same(rendered(scene, 256).film, render_scene(scene, options, {}, exchanged).film);
}

TEST(Sampling, TwoSurfacesOfOneProposalFollowTheSamePaths) {
  // Half the reflectance gives exactly half the light of every sample where paths are the same and end at the first bounce.
  const std::string head = R"({"camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fov": 15}, "film": {"width": 8, "height": 8}, "path": {"max_depth": 1},
    "environment": {"type": "sky", "width": 64}, "shapes": [{"type": "sphere", "material": "m"}], "materials": {"m": )";
  const Scene bright = scene_of(head + R"({"type": "ggx", "alpha": 0.3, "f0": 0.8}}})"), dim = scene_of(head + R"({"type": "lambert", "albedo": 0.4}}})"),
              dimmer = scene_of(head + R"({"type": "lambert", "albedo": 0.2}}})");
  const Proposal& shared = bright.materials[0].surface.proposal();
  RenderOptions options;
  options.spp = 8;
  const std::vector<Surface> a{dim.materials[0].surface.with_proposal(shared)}, b{dimmer.materials[0].surface.with_proposal(shared)};
  const Image p = render_scene(bright, options, {}, a).film.image(), q = render_scene(bright, options, {}, b).film.image();
  for (std::size_t i = 0; i < p.pixels.size(); ++i) EXPECT_NEAR(p.pixels[i].x, 2 * q.pixels[i].x, 1e-4f * p.pixels[i].x);
}

}  // namespace
}  // namespace brdf::render::test

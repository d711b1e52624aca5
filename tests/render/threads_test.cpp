// SPDX-License-Identifier: Apache-2.0
// Threads, seeds, interruption and observers.
#include "rendered_scene.h"
#include "support/expect_error.h"

#include <atomic>

namespace brdf::render::test {
namespace {

Scene small_scene() {
  return scene_of(R"({"camera": {"position": [0, 0.5, 4], "target": [0, 0, 0], "fov": 40}, "film": {"width": 40, "height": 36},
    "environment": {"type": "sky", "width": 64}, "materials": {"m": {"type": "ggx", "alpha": 0.2, "f0": 0.6}, "d": {"type": "lambert", "albedo": 0.6}, "glass": {"type": "dielectric", "ior": 1.5}},
    "shapes": [{"type": "sphere", "material": "m"}, {"type": "sphere", "material": "glass", "centre": [1.2, 0, 1], "radius": 0.4},
               {"type": "quad", "material": "d", "corner": [-5, -1, 5], "edge_u": [10, 0, 0], "edge_v": [0, 0, -10]}]})");
}

TEST(Threads, DoNotChangeThePicture) {
  const Scene scene = small_scene();
  RenderOptions options;
  options.spp = 9;  // several passes, the last one cut
  options.threads = 1;
  const RenderResult one = render_scene(scene, options);
  EXPECT_TRUE(one.complete);
  EXPECT_EQ(one.counts.paths, 40U * 36U * 9U);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const RenderResult many = render_scene(scene, options);
    EXPECT_EQ(many.film.image().pixels, one.film.image().pixels) << threads << " threads";
    EXPECT_EQ(many.counts.vertices, one.counts.vertices);
  }
  options.seed = 7;
  EXPECT_NE(render_scene(scene, options).film.image().pixels, one.film.image().pixels);
}

TEST(Threads, AnInterruptedRenderingKeepsWhatThereIs) {
  const Scene scene = small_scene();
  RenderOptions options;
  options.spp = 1 << 20;  // would take days
  options.threads = 2;
  int calls = 0;
  const RenderResult result = render_scene(scene, options, [&calls](std::string_view, double done) {
    EXPECT_GE(done, 0);
    EXPECT_LE(done, 1);
    return ++calls < 3;
  });
  EXPECT_FALSE(result.complete);
  EXPECT_GE(result.film.fewest_samples(), 1U);
  EXPECT_GT(mean_of(result.film).value, 0);
}

TEST(Threads, ATimeLimitEndsBetweenPasses) {
  RenderOptions options;
  options.spp = 1 << 20;
  options.threads = 2;
  options.seconds = 0.05;
  const RenderResult result = render_scene(small_scene(), options);
  EXPECT_TRUE(result.complete);
  EXPECT_LT(result.film.fewest_samples(), 1U << 20);
  EXPECT_EQ(result.film.samples(), 40U * 36U * result.film.fewest_samples());
}

TEST(Threads, BadOptionsAreRefused) {
  const Scene scene = small_scene();
  for (const int spp : {0, -1, (1 << 20) + 1}) {
    RenderOptions options;
    options.spp = spp;
    brdf::test::expect_error(ErrorCode::invalid_argument, {"spp", std::to_string(spp).c_str()}, [&] { render_scene(scene, options); });
  }
  RenderOptions options;
  options.threads = -1;
  brdf::test::expect_error(ErrorCode::invalid_argument, {"threads"}, [&] { render_scene(scene, options); });
}

struct Sums : PathObserver {
  double contribution_of_first = 0, pixels = 0;
  std::uint64_t rays = 0, shadow_rays = 0, samples = 0;
  void query(const MaterialQuery& q) noexcept override {
    pixels += static_cast<double>(q.pixels);
    if ((q.operations & query_sample) != 0) ++samples;
    EXPECT_GE(q.contribution, 0);
    EXPECT_LT(q.slot, 3U);
  }
  void ray(const Ray&, float, bool is_shadow) noexcept override { ++(is_shadow ? shadow_rays : rays); }
};

TEST(Threads, ObserversHearOfEveryQueryAndChangeNothing) {
  const Scene scene = small_scene();
  RenderOptions options;
  options.spp = 4;
  options.threads = 2;
  const RenderResult plain = render_scene(scene, options);
  std::array<Sums, 2> sums;
  const std::array<PathObserver*, 2> observers{&sums[0], &sums[1]};
  const RenderResult observed = render_scene(scene, options, {}, {}, observers);
  EXPECT_EQ(plain.film.image().pixels, observed.film.image().pixels);
  EXPECT_EQ(sums[0].rays + sums[1].rays, observed.counts.rays);
  EXPECT_EQ(sums[0].shadow_rays + sums[1].shadow_rays, observed.counts.shadow_rays);
  EXPECT_EQ(sums[0].samples + sums[1].samples, observed.counts.vertices);
  EXPECT_GT(sums[0].pixels + sums[1].pixels, 0);
  EXPECT_LE(sums[0].pixels + sums[1].pixels, static_cast<double>(observed.counts.paths));
}

/// Contribution by kind of query, of paths that end after one vertex.
struct OneVertex : PathObserver {
  double contribution = 0;
  void query(const MaterialQuery& q) noexcept override { contribution += static_cast<double>(q.contribution); }
};

TEST(Threads, ContributionsOfOneBounceAddUpToThePicture) {
  const Scene scene = scene_of(R"({"camera": {"position": [0, 1, 3], "target": [0, 0, 0], "fov": 10}, "film": {"width": 8, "height": 8}, "path": {"max_depth": 1},
    "environment": {"type": "sky", "width": 64}, "materials": {"m": {"type": "ggx", "alpha": 0.4, "f0": 0.6}},
    "shapes": [{"type": "quad", "material": "m", "corner": [-5, 0, 5], "edge_u": [10, 0, 0], "edge_v": [0, 0, -10]}]})");
  OneVertex observer;
  const std::array<PathObserver*, 1> observers{&observer};
  RenderOptions options;
  options.spp = 16;
  options.threads = 1;
  const RenderResult result = render_scene(scene, options, {}, {}, observers);
  const double sum = mean_of(result.film).value * static_cast<double>(result.counts.paths);
  EXPECT_NEAR(observer.contribution, sum, 1e-4 * sum);
}

}  // namespace
}  // namespace brdf::render::test

// SPDX-License-Identifier: Apache-2.0
// Rays per second of the renderer with a Lambertian on more than 100 000 triangles under one sky, against a bare Embree loop over
// the very same rays; one thread each. The counter "share" of the renderer is its part of the bare loop's speed.
#include "path/render_scene.h"
#include "scene/embree.h"
#include "scene/scene.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <ctime>
#include <limits>
#include <vector>

namespace {

using namespace brdf::render;

constexpr const char* scene_text = R"({
  "camera": {"position": [0, 2.2, 5.2], "target": [0, 0.3, 0], "fov": 40}, "film": {"width": 320, "height": 240},
  "path": {"max_depth": 8},
  "environment": {"type": "sky", "width": 512, "lamps": [{"direction": [1, 1, 0.5], "size": 10, "radiance": 20}]},
  "materials": {"grey": {"type": "lambert", "albedo": 0.6}},
  "shapes": [
    {"type": "terrain", "material": "grey", "segments": 200, "amplitude": 0.12, "frequency": 3, "octaves": 5, "transform": [{"scale": [4, 3, 4]}]},
    {"type": "blob", "material": "grey", "segments": 120, "amplitude": 0.2, "frequency": 3, "octaves": 4, "transform": [{"scale": 0.8}, {"translate": [-1, 0.9, 0]}]},
    {"type": "blob", "material": "grey", "segments": 120, "amplitude": 0.3, "frequency": 2, "octaves": 5, "seed": 3, "transform": [{"scale": 0.8}, {"translate": [1, 0.9, 0.4]}]}
  ]})";

constexpr int spp = 4;

struct RecordedRay {
  Ray ray;
  float distance;
  bool is_shadow;
};

struct Recorder : PathObserver {
  std::vector<RecordedRay> rays;
  void ray(const Ray& r, float distance, bool is_shadow) noexcept override { rays.push_back({r, distance, is_shadow}); }
};

const Scene& scene() {
  static const Scene s = load_scene(parse_scene(scene_text, "bench.json"));
  return s;
}

RenderOptions options() {
  RenderOptions o;
  o.spp = spp;
  o.threads = 1;
  return o;
}

/// What any ray tracer must do: fill in a ray, ask Embree, look at the answer.
std::uint64_t bare_loop(const std::vector<RecordedRay>& rays) {
  RTCScene embree = scene().geometry.embree_scene();
  std::uint64_t hits = 0;
  for (const RecordedRay& r : rays) {
    RTCRayHit query;
    query.ray = {r.ray.origin.x, r.ray.origin.y, r.ray.origin.z, 0, r.ray.direction.x, r.ray.direction.y, r.ray.direction.z, 0, r.distance, ~0U, 0, 0};
    if (r.is_shadow) {
      embree_occluded(embree, query.ray);
      hits += query.ray.tfar < 0;
    } else {
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      embree_intersect(embree, query);
      hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

const std::vector<RecordedRay>& recorded() {
  static const std::vector<RecordedRay> rays = [] {
    Recorder recorder;
    const std::array<PathObserver*, 1> observers{&recorder};
    render_scene(scene(), options(), {}, {}, observers);
    return recorder.rays;
  }();
  return rays;
}

void bare(benchmark::State& state) {
  const auto& rays = recorded();
  for (auto _ : state) benchmark::DoNotOptimize(bare_loop(rays));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

/// Both in turns and by the processor's time of this process, so that what else the machine does matters little.
void renderer(benchmark::State& state) {
  const auto& rays = recorded();
  double bare_seconds = 0, seconds = 0;
  for (auto _ : state) {
    const auto start = std::clock();
    const RenderResult result = render_scene(scene(), options());
    const auto middle = std::clock();
    if (result.counts.rays + result.counts.shadow_rays != rays.size()) state.SkipWithError("the renderer traced other rays");
    benchmark::DoNotOptimize(bare_loop(rays));
    seconds += static_cast<double>(middle - start) / CLOCKS_PER_SEC;
    bare_seconds += static_cast<double>(std::clock() - middle) / CLOCKS_PER_SEC;
  }
  const double count = static_cast<double>(state.iterations()) * static_cast<double>(rays.size());
  state.counters["rays/s"] = count / seconds;
  state.counters["bare rays/s"] = count / bare_seconds;
  state.counters["share"] = bare_seconds / seconds;
  state.counters["triangles"] = static_cast<double>(scene().geometry.triangles());
}

BENCHMARK(bare)->Unit(benchmark::kMillisecond);
BENCHMARK(renderer)->Unit(benchmark::kMillisecond);

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// Radiance along one camera ray.
#pragma once

#include "path/path_observer.h"
#include "path/random.h"
#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

namespace brdf::render {

/// Where directions come from at each vertex.
enum class Sampling : std::uint8_t {
  mis,     ///< lights and materials, combined by the power heuristic (Veach 1997, eq. 9.11 with beta = 2)
  bsdf,    ///< materials alone, but for directional lights, which no ray can meet
  light,   ///< lights alone, but for what delta lobes reflect
  cosine,  ///< as mis, with materials that draw by the cosine
  lobes,   ///< as mis, with materials that draw by their lobes and not by their tables
};
const char* to_string(Sampling sampling) noexcept;

struct PathCounts {
  std::uint64_t paths = 0, vertices = 0, rays = 0, shadow_rays = 0;
  void operator+=(const PathCounts& other) noexcept {
    paths += other.paths;
    vertices += other.vertices;
    rays += other.rays;
    shadow_rays += other.shadow_rays;
  }
};

/// The surfaces of a scene's slots as a way of sampling wants them.
std::vector<Surface> surfaces_for(const Scene& scene, Sampling sampling);

/// Refers to the scene and the surfaces, one per slot, which must outlive it. Thread-safe but for the observer.
class PathTracer {
 public:
  PathTracer(const Scene& scene, std::span<const Surface> surfaces, Sampling sampling) noexcept;

  /// A path under way. It starts as a ray of the camera and its random numbers.
  struct Path {
    Ray ray;
    Random random;
    Vec3f radiance{0};  ///< the result

    Vec3f throughput{1};
    Intersection met;         ///< of the ray
    Environment::Patch patch; ///< of the environment where it met nothing
    LightDraw light;          ///< for the vertex where it met something
    float drawn_pdf = 0, eta_scale = 1;
    int depth = 0;
    bool delta = true;        ///< how the ray was drawn; the camera's own choice of direction is one
    bool seen_first = true;   ///< nothing but delta lobes between here and the camera
  };
  static constexpr std::size_t most_paths = GeometryStore::packet;
  /// Traces at most `most_paths` paths from neighbouring places of the film, a vertex of each in turn: what one needs from memory
  /// comes while the others are at work. `observer` may be null.
  void trace(std::span<Path> paths, PathCounts& counts, PathObserver* observer) const noexcept;

 private:
  template <class Log>
  void trace(std::span<Path> paths, std::span<Log> logs, PathCounts& counts, PathObserver* observer) const noexcept;
  /// Shades the vertex that the ray arrives at and leaves the next ray; false where the path ends.
  template <class Log>
  bool advance(Path& path, Log& log, PathCounts& counts, PathObserver* observer) const noexcept;
  /// Asks memory for what `advance` needs where the ray has arrived.
  void arrive(Path& path) const noexcept;
  Vec3f direct_light(const LightSample& light, const Hit& hit, const Surface& surface, const Vec3f& wo, bool flipped, Vec3f& wi, Ray& shadow,
                     float& distance) const noexcept;
  /// Share of what a ray that was drawn with `drawn_pdf` finds, given that light sampling finds it with `light_pdf`.
  float share_of_bsdf(bool delta, float drawn_pdf, float light_pdf) const noexcept;

  const Scene* scene_;
  std::span<const Surface> surfaces_;
  int max_depth_, roulette_depth_;
  bool lights_by_bsdf_, lights_by_choice_;  ///< which strategies count
  bool choose_lights_;                      ///< whether there is anything to choose
};

}  // namespace brdf::render

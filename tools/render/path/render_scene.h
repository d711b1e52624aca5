// SPDX-License-Identifier: Apache-2.0
// A picture of a scene, in passes, on threads.
#pragma once

#include "path/film.h"
#include "path/path_tracer.h"

#include <brdf/progress.h>

#include <cstdint>
#include <span>
#include <string>

namespace brdf::render {

struct RenderOptions {
  int spp = 64;                    ///< samples per pixel, 1 to 2^20
  int threads = 0;                 ///< 0: one per processor. The picture does not depend on it
  std::uint64_t seed = 0;
  Sampling sampling = Sampling::mis;
  double seconds = 0;              ///< above 0: passes begin until this much time has passed, at most spp samples
};

struct RenderResult {
  Film film;
  PathCounts counts;
  double seconds = 0;              ///< of wall time, without loading
  double processor_seconds = 0;    ///< of the whole process meanwhile: on a busy machine less than threads times `seconds`
  int threads = 0;
  bool complete = false;           ///< false: it was cancelled, and the film holds what there was

  /// Time of one thread per vertex, everything included.
  double ns_per_vertex() const noexcept {
    return counts.vertices > 0 ? seconds * threads * 1e9 / static_cast<double>(counts.vertices) : 0;
  }
  double rays_per_second() const noexcept {
    return seconds > 0 ? static_cast<double>(counts.rays + counts.shadow_rays) / seconds : 0;
  }
};

/// Renders. Pixels depend on scene, surfaces, seed and spp alone. `progress` is called from the calling thread about ten times a
/// second; when it returns false, rendering stops within some milliseconds and what there is is returned, which is not an error.
/// `surfaces`, one per slot, take the place of the scene's own; none: those of the scene as `sampling` wants them.
/// `observers`: none, or at least as many as threads. Throws Error(invalid_argument).
RenderResult render_scene(const Scene& scene, const RenderOptions& options, const Progress& progress = {},
                          std::span<const Surface> surfaces = {}, std::span<PathObserver* const> observers = {});

/// How many threads `wanted` means.
int render_threads(int wanted) noexcept;

}  // namespace brdf::render

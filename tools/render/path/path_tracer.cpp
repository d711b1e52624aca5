// SPDX-License-Identifier: Apache-2.0
#include "path/path_tracer.h"

#include "path/query_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

namespace brdf::render {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// Weight of the strategy with density p against one with density q: the power heuristic, without p * p overflowing.
float power_heuristic(float p, float q) noexcept {
  if (!(p > 0)) return 0;
  const float ratio = q / p;
  return 1 / (1 + ratio * ratio);
}

/// Directions between the world and a hit's frame.
struct Frame {
  Vec3f x, y, z;
  Vec3f local(const Vec3f& v) const noexcept { return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)}; }
  Vec3f world(const Vec3f& v) const noexcept { return x * v.x + y * v.y + z * v.z; }
};

/// Stands for a QueryLog where nobody observes.
struct NoLog {};

}  // namespace

const char* to_string(Sampling sampling) noexcept {
  switch (sampling) {
    case Sampling::mis: return "mis";
    case Sampling::bsdf: return "bsdf";
    case Sampling::light: return "light";
    case Sampling::cosine: return "cosine";
    case Sampling::lobes: return "lobes";
  }
  return "unknown";
}

std::vector<Surface> surfaces_for(const Scene& scene, Sampling sampling) {
  std::vector<Surface> surfaces;
  for (const MaterialSlot& slot : scene.materials) {
    if (sampling == Sampling::cosine) surfaces.push_back(slot.surface.with_proposal(Proposal()));
    else if (sampling == Sampling::lobes) surfaces.push_back(slot.surface.with_proposal(slot.surface.proposal().of_lobes()));
    else surfaces.push_back(slot.surface);
  }
  return surfaces;
}

PathTracer::PathTracer(const Scene& scene, std::span<const Surface> surfaces, Sampling sampling) noexcept
    : scene_(&scene),
      surfaces_(surfaces),
      max_depth_(scene.description.path.max_depth),
      roulette_depth_(scene.description.path.roulette_depth),
      lights_by_bsdf_(sampling != Sampling::light),
      lights_by_choice_(sampling != Sampling::bsdf),
      choose_lights_(!scene.lights.empty() && (lights_by_choice_ || scene.lights.has_directional())) {}

float PathTracer::share_of_bsdf(bool delta, float drawn_pdf, float light_pdf) const noexcept {
  if (delta || !lights_by_choice_) return 1;
  return lights_by_bsdf_ ? power_heuristic(drawn_pdf, light_pdf) : 0.0f;
}

Vec3f PathTracer::direct_light(const LightSample& light, const Hit& hit, const Surface& surface, const Vec3f& wo, bool flipped, Vec3f& wi,
                               Ray& shadow, float& distance) const noexcept {
  if (!(light.pdf > 0) || (!light.is_delta && !lights_by_choice_)) return Vec3f(0);
  const float side = flipped ? -1.0f : 1.0f;
  // light through the surface by its shading normal, although the surface itself is in between
  if (!(glm::dot(hit.facet, light.direction) * side > 0)) return Vec3f(0);
  wi = Frame{hit.tangent, hit.bitangent, hit.normal}.local(light.direction);
  if (!(wi.z > 0)) return Vec3f(0);
  const Vec3f f = surface.eval(wi, wo);
  if (f == Vec3f(0)) return Vec3f(0);
  float weight = 1;
  if (!light.is_delta && lights_by_bsdf_) weight = power_heuristic(light.pdf, surface.pdf(wi, wo));
  shadow = {offset_point(hit.point, hit.facet, light.direction), light.direction};
  distance = light.distance * (1 - 1e-4f);
  return f * light.radiance * (wi.z * weight / light.pdf);
}

void PathTracer::arrive(Path& path) const noexcept {
  if (!path.met.is_hit()) {
    path.patch = scene_->lights.patch(path.ray.direction);
    return;
  }
  scene_->geometry.prefetch(path.met);
  if (!choose_lights_) return;
  const float choose = path.random.next();
  path.light = scene_->lights.draw(choose, path.random.next2());
}

template <class Log>
bool PathTracer::advance(Path& path, Log& log, PathCounts& counts, PathObserver* observer) const noexcept {
  constexpr bool observed = std::is_same_v<Log, QueryLog>;
  const Ray ray = path.ray;
  if (!path.met.is_hit()) {
    float light_pdf;
    const Vec3f light = scene_->lights.background(ray.direction, path.patch, light_pdf);
    path.radiance += path.throughput * light * share_of_bsdf(path.delta, path.drawn_pdf, light_pdf);
    return false;
  }
  const std::uint32_t slot = scene_->material_of[path.met.shape];
  const Surface& surface = surfaces_[slot];
  Hit hit = scene_->geometry.hit(ray, path.met, surface.has_grain());
  if (const std::uint32_t area = scene_->light_of[hit.shape]; area != no_index) {
    float light_pdf;
    const Vec3f emitted = scene_->lights.area(area, -glm::dot(hit.facet, ray.direction), hit.distance, light_pdf);
    path.radiance += path.throughput * emitted * share_of_bsdf(path.delta, path.drawn_pdf, light_pdf);
  }
  if (path.depth >= max_depth_) return false;
  ++counts.vertices;

  const Vec3f back = -ray.direction;
  const bool from_behind = glm::dot(hit.facet, back) < 0;
  // A shading normal that looks away from the viewer describes no surface that the viewer could see.
  if ((glm::dot(hit.normal, back) < 0) != from_behind) {
    hit.normal = hit.facet;
    make_frame(hit.normal, hit.tangent, hit.bitangent);
  }
  const bool flipped = from_behind && !surface.transmits();  // reflectors look the same from behind
  if (flipped) {
    hit.normal = -hit.normal;
    hit.bitangent = -hit.bitangent;
  }
  const Frame frame{hit.tangent, hit.bitangent, hit.normal};
  const Vec3f wo = frame.local(back);

  if (choose_lights_ && surface.has_values()) {
    const LightSample light = scene_->lights.sample(path.light, hit.point);
    Vec3f wi;
    Ray shadow;
    float distance;
    Vec3f lit = direct_light(light, hit, surface, wo, flipped, wi, shadow, distance);
    if (lit != Vec3f(0)) {
      ++counts.shadow_rays;
      if constexpr (observed) observer->ray(shadow, distance, true);
      if (scene_->geometry.occluded(shadow, distance)) lit = Vec3f(0);
      lit *= path.throughput;
      path.radiance += lit;
      if constexpr (observed) {
        const std::uint32_t operations = query_eval | (lights_by_bsdf_ ? query_pdf : 0U);
        log.add({slot, operations, sample_reflection, wi, wo, luminance(lit), 0}, path.radiance);
      }
    }
  }

  const SurfaceSample s = surface.sample(wo, path.random.next3(), TransportMode::radiance);
  const bool is_seen_first = path.seen_first && (s.flags & sample_delta) == 0;
  if constexpr (observed) {
    log.add({slot, query_sample, s.flags, s.wi, wo, 0, is_seen_first ? 1.0f : 0.0f}, path.radiance);
  }
  path.seen_first = path.seen_first && !is_seen_first;
  if (!(s.pdf > 0) || s.weight == Vec3f(0)) return false;
  const Vec3f direction = glm::normalize(frame.world(s.wi));
  const float facet_side = glm::dot(hit.facet, direction) * (flipped ? -1.0f : 1.0f);
  if ((facet_side > 0) != (s.wi.z > 0)) return false;  // as for direct light
  path.throughput *= s.weight;
  path.eta_scale *= s.eta * s.eta;
  path.delta = (s.flags & sample_delta) != 0;
  path.drawn_pdf = s.pdf;
  path.ray = {offset_point(hit.point, hit.facet, direction), direction};

  if (++path.depth >= roulette_depth_) {
    // The factor of eta squared is undone again when light leaves the medium; it must not decide about the path.
    const float survival = std::min(0.95f, std::max({path.throughput.x, path.throughput.y, path.throughput.z}) * path.eta_scale);
    if (path.random.next() >= survival) return false;
    path.throughput /= survival;
  }
  return true;
}

template <class Log>
void PathTracer::trace(std::span<Path> paths, std::span<Log> logs, PathCounts& counts, PathObserver* observer) const noexcept {
  std::array<Ray, most_paths> rays;
  std::array<Intersection, most_paths> met;
  std::array<std::size_t, most_paths> under_way;
  std::size_t left = paths.size();
  counts.paths += paths.size();
  for (std::size_t i = 0; i < paths.size(); ++i) {
    rays[i] = paths[i].ray;
    under_way[i] = i;
  }
  scene_->geometry.intersect(std::span(rays).first(paths.size()), met);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    paths[i].met = met[i];
    arrive(paths[i]);
  }
  while (left > 0) {
    counts.rays += left;
    if (choose_lights_) {
      for (std::size_t k = 0; k < left; ++k) {
        if (paths[under_way[k]].met.is_hit()) scene_->lights.finish(paths[under_way[k]].light);
      }
    }
    std::size_t going_on = 0;
    for (std::size_t k = 0; k < left; ++k) {
      const std::size_t i = under_way[k];
      if constexpr (std::is_same_v<Log, QueryLog>) observer->ray(paths[i].ray, infinite, false);
      if (advance(paths[i], logs[i], counts, observer)) under_way[going_on++] = i;
    }
    left = going_on;
    for (std::size_t k = 0; k < left; ++k) {
      Path& path = paths[under_way[k]];
      path.met = scene_->geometry.intersect(path.ray);
      arrive(path);
    }
  }
  if constexpr (std::is_same_v<Log, QueryLog>) {
    for (std::size_t i = 0; i < paths.size(); ++i) logs[i].report(paths[i].radiance, *observer);
  }
}

void PathTracer::trace(std::span<Path> paths, PathCounts& counts, PathObserver* observer) const noexcept {
  if (observer) {
    std::array<QueryLog, most_paths> logs;
    trace<QueryLog>(paths, logs, counts, observer);
  } else {
    std::array<NoLog, most_paths> none;
    trace<NoLog>(paths, none, counts, nullptr);
  }
}

}  // namespace brdf::render

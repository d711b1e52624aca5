// SPDX-License-Identifier: Apache-2.0
#include "path/path_tracer.h"

#include "light/luminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

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

/// Queries of the path so far, whose contributions come to light only at its end.
class QueryLog {
 public:
  void add(const MaterialQuery& query, const Vec3f& radiance_before) noexcept {
    if (size_ < entries_.size()) entries_[size_++] = {query, luminance(radiance_before)};
  }
  void report(const Vec3f& radiance, PathObserver& observer) noexcept {
    const float whole = luminance(radiance);
    for (std::size_t i = 0; i < size_; ++i) {
      Entry& e = entries_[i];
      if ((e.query.operations & query_sample) != 0) e.query.contribution = std::max(0.0f, whole - e.before);
      observer.query(e.query);
    }
  }

 private:
  struct Entry {
    MaterialQuery query;
    float before = 0;  ///< what the path had gathered when it went on from here; what comes later passes through this pair
  };
  std::array<Entry, 256> entries_;
  std::size_t size_ = 0;
};

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

Vec3f PathTracer::direct_light(const Hit& hit, const Surface& surface, const Vec3f& wo, bool flipped, Random& random, Vec3f& wi, Ray& shadow,
                               float& distance) const noexcept {
  const float choose = random.next();
  const LightSample light = scene_->lights.sample(hit.point, choose, random.next2());
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

template <bool observed>
Vec3f PathTracer::trace(Ray ray, Random& random, PathCounts& counts, PathObserver* observer) const noexcept {
  std::conditional_t<observed, QueryLog, NoLog> log;
  Vec3f radiance(0), throughput(1);
  float drawn_pdf = 0, eta_scale = 1;
  bool delta = true;        // the camera's own choice of direction is one
  bool seen_first = true;   // nothing but delta lobes between here and the camera
  ++counts.paths;
  for (int depth = 0;; ++depth) {
    Hit hit;
    ++counts.rays;
    if constexpr (observed) observer->ray(ray, infinite, false);
    if (!scene_->geometry.intersect(ray, hit)) {
      float light_pdf;
      const Vec3f light = scene_->lights.background(ray.direction, light_pdf);
      radiance += throughput * light * share_of_bsdf(delta, drawn_pdf, light_pdf);
      break;
    }
    if (const std::uint32_t light = scene_->light_of[hit.shape]; light != no_index) {
      float light_pdf;
      const Vec3f emitted = scene_->lights.area(light, -glm::dot(hit.facet, ray.direction), hit.distance, light_pdf);
      radiance += throughput * emitted * share_of_bsdf(delta, drawn_pdf, light_pdf);
    }
    if (depth >= max_depth_) break;
    ++counts.vertices;

    const std::uint32_t slot = scene_->material_of[hit.shape];
    const Surface& surface = surfaces_[slot];
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
      Vec3f wi;
      Ray shadow;
      float distance;
      Vec3f light = direct_light(hit, surface, wo, flipped, random, wi, shadow, distance);
      if (light != Vec3f(0)) {
        ++counts.shadow_rays;
        if constexpr (observed) observer->ray(shadow, distance, true);
        if (scene_->geometry.occluded(shadow, distance)) light = Vec3f(0);
        light *= throughput;
        radiance += light;
        if constexpr (observed) {
          const std::uint32_t operations = query_eval | (lights_by_bsdf_ ? query_pdf : 0U);
          log.add({slot, operations, sample_reflection, wi, wo, luminance(light), 0}, radiance);
        }
      }
    }

    const SurfaceSample s = surface.sample(wo, random.next3(), TransportMode::radiance);
    const bool is_seen_first = seen_first && (s.flags & sample_delta) == 0;
    if constexpr (observed) {
      log.add({slot, query_sample, s.flags, s.wi, wo, 0, is_seen_first ? 1.0f : 0.0f}, radiance);
    }
    seen_first = seen_first && !is_seen_first;
    if (!(s.pdf > 0) || s.weight == Vec3f(0)) break;
    const Vec3f direction = glm::normalize(frame.world(s.wi));
    const float facet_side = glm::dot(hit.facet, direction) * (flipped ? -1.0f : 1.0f);
    if ((facet_side > 0) != (s.wi.z > 0)) break;  // as for direct light
    throughput *= s.weight;
    eta_scale *= s.eta * s.eta;
    delta = (s.flags & sample_delta) != 0;
    drawn_pdf = s.pdf;
    ray = {offset_point(hit.point, hit.facet, direction), direction};

    if (depth + 1 >= roulette_depth_) {
      // The factor of eta squared is undone again when light leaves the medium; it must not decide about the path.
      const float survival = std::min(0.95f, std::max({throughput.x, throughput.y, throughput.z}) * eta_scale);
      if (random.next() >= survival) break;
      throughput /= survival;
    }
  }
  if constexpr (observed) log.report(radiance, *observer);
  return radiance;
}

Vec3f PathTracer::radiance(Ray ray, Random& random, PathCounts& counts, PathObserver* observer) const noexcept {
  return observer ? trace<true>(ray, random, counts, observer) : trace<false>(ray, random, counts, nullptr);
}

}  // namespace brdf::render

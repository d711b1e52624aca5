// SPDX-License-Identifier: Apache-2.0
// Every light of a scene, and the choice of one for next-event estimation.
#pragma once

#include "light/environment.h"

#include <brdf/direction.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace brdf::render {

/// Triangles of one shape that emit the same radiance to their front side.
struct AreaLight {
  Vec3f radiance{0};
  std::vector<Vec3f> corners;  ///< three per triangle
};

/// Parallel light. `irradiance` is that of a surface at right angles to it.
struct DirectionalLight {
  Vec3f to_light{0, 1, 0};  ///< unit vector
  Vec3f irradiance{1};
};

struct LightSample {
  Vec3f direction{0};       ///< unit vector from the point to the light
  float distance = 0;       ///< infinite for lights that are
  Vec3f radiance{0};        ///< irradiance of a delta light
  float pdf = 0;            ///< per solid angle, with the probability of the choice; for a delta light that alone; 0: no light
  bool is_delta = false;
};

/// A light that was chosen, and a place on it. It can be drawn before the point is known that is to be lit, and in two steps:
/// what each reads is far away in memory.
struct LightDraw {
  std::size_t light = 0;
  glm::vec2 u{0, 0};
  PiecewiseConstant1D::Draw row;  ///< after the first
  Environment::Draw sky;          ///< after the second
};

/// Immutable and thread-safe. One light is chosen with a fixed probability: half evenly, half by estimated power.
class Lights {
 public:
  Lights() = default;
  /// `radius`: of a ball around the scene, which says how much light from afar meets it.
  Lights(std::optional<Environment> environment, std::vector<AreaLight> areas, std::vector<DirectionalLight> directional, float radius);

  bool empty() const noexcept { return choice_.size() == 0; }
  bool has_directional() const noexcept { return !directional_.empty(); }

  /// `choose` picks the light, `u` the place on it. What `finish` will read is asked for.
  LightDraw draw(float choose, const glm::vec2& u) const noexcept;
  /// Asks for what `sample` will read.
  void finish(LightDraw& draw) const noexcept;
  LightSample sample(const LightDraw& draw, const Vec3f& point) const noexcept;

  /// Radiance of the environment, and the pdf that a draw has for that direction, whose `patch` is given.
  Vec3f background(const Vec3f& direction, const Environment::Patch& patch, float& pdf) const noexcept {
    pdf = 0;
    if (!environment_) return Vec3f(0);
    const Vec3f radiance = environment_->radiance(direction, patch, pdf);
    pdf *= choice_.probability(choice_.size() - 1);
    return radiance;
  }
  /// Where a direction looks. What `background` will read is asked for.
  Environment::Patch patch(const Vec3f& direction) const noexcept {
    if (!environment_) return {};
    const Environment::Patch patch = environment_->patch(direction);
    environment_->prefetch(patch);
    return patch;
  }
  bool has_environment() const noexcept { return environment_.has_value(); }

  /// Radiance of area light `i`, seen at `cosine` to its normal over `distance`, and the pdf that `sample` has there.
  Vec3f area(std::uint32_t i, float cosine, float distance, float& pdf) const noexcept;

 private:
  bool is_environment(std::size_t light) const noexcept { return environment_ && light + 1 == choice_.size(); }

  struct Area {
    Vec3f radiance;
    float area = 0;
    std::vector<Vec3f> corners;
    PiecewiseConstant1D triangles;
  };
  LightSample sample_area(const Area& light, const Vec3f& point, const glm::vec2& u) const noexcept;

  std::optional<Environment> environment_;
  std::vector<Area> areas_;
  std::vector<DirectionalLight> directional_;
  PiecewiseConstant1D choice_;  ///< areas, directional lights, environment
};

}  // namespace brdf::render

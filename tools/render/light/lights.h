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

/// Immutable and thread-safe. One light is chosen with a fixed probability: half evenly, half by estimated power.
class Lights {
 public:
  Lights() = default;
  /// `radius`: of a ball around the scene, which says how much light from afar meets it.
  Lights(std::optional<Environment> environment, std::vector<AreaLight> areas, std::vector<DirectionalLight> directional, float radius);

  bool empty() const noexcept { return choice_.size() == 0; }
  bool has_directional() const noexcept { return !directional_.empty(); }

  /// `choose` picks the light, `u` the place on it.
  LightSample sample(const Vec3f& point, float choose, const glm::vec2& u) const noexcept;

  /// Radiance of the environment, and the pdf that `sample` has for that direction.
  Vec3f background(const Vec3f& direction, float& pdf) const noexcept;
  bool has_environment() const noexcept { return environment_.has_value(); }

  /// Radiance of area light `i`, seen at `cosine` to its normal over `distance`, and the pdf that `sample` has there.
  Vec3f area(std::uint32_t i, float cosine, float distance, float& pdf) const noexcept;

 private:
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

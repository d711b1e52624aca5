// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include "light/lat_long.h"

#include "light/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// 1 within the lamp, 0 outside, with an edge as wide as two pixels so that no pixel decides alone.
float coverage(const SkyLamp& lamp, const Vec3f& d, float edge) {
  const Vec3f axis = glm::normalize(lamp.direction);
  const float along = glm::dot(axis, d);
  if (along <= 0) return 0;
  const float half_width = 0.5f * lamp.width * degree, half_height = 0.5f * lamp.height * degree;
  if (lamp.round) {
    const float angle = std::atan2(glm::length(glm::cross(axis, d)), along);
    return 1 - smooth_step(half_width - edge, half_width + edge, angle);
  }
  const Vec3f aside = glm::normalize(std::abs(axis.y) < 0.999f ? glm::cross(Vec3f(0, 1, 0), axis) : Vec3f(1, 0, 0));
  const Vec3f up = glm::cross(axis, aside);
  const float x = std::atan2(std::abs(glm::dot(aside, d)), along), y = std::atan2(std::abs(glm::dot(up, d)), along);
  return (1 - smooth_step(half_width - edge, half_width + edge, x)) * (1 - smooth_step(half_height - edge, half_height + edge, y));
}

}  // namespace

Image make_sky(const SkyDescription& sky) {
  Image map(sky.width, sky.width / 2);
  const float pixel = 360 * degree / static_cast<float>(map.width);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(map.width),
                         (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
      const Vec3f d = direction_at(uv);
      Vec3f radiance = sky.ground;
      if (d.y > 0) radiance = sky.horizon + (sky.zenith - sky.horizon) * std::sqrt(d.y);
      for (const SkyLamp& lamp : sky.lamps) {
        const float share = coverage(lamp, d, pixel);
        radiance = radiance * (1 - share) + lamp.radiance * share;
      }
      map.at(x, y) = radiance;
    }
  }
  return map;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "light/lights.h"

#include "image/luminance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

namespace brdf::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

}  // namespace

Lights::Lights(std::optional<Environment> environment, std::vector<AreaLight> areas, std::vector<DirectionalLight> directional,
               float radius)
    : environment_(std::move(environment)), directional_(std::move(directional)) {
  std::vector<double> power;
  const float disc = pi * radius * radius;
  for (AreaLight& a : areas) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i + 2 < a.corners.size(); i += 3) {
      sizes.push_back(0.5 * static_cast<double>(glm::length(glm::cross(a.corners[i + 1] - a.corners[i], a.corners[i + 2] - a.corners[i]))));
    }
    Area light;
    light.radiance = a.radiance;
    light.corners = std::move(a.corners);
    light.triangles = PiecewiseConstant1D(sizes);
    light.area = static_cast<float>(light.triangles.sum());
    power.push_back(static_cast<double>(pi * light.area * luminance(light.radiance)));
    areas_.push_back(std::move(light));
  }
  for (const DirectionalLight& d : directional_) power.push_back(static_cast<double>(disc * luminance(d.irradiance)));
  if (environment_) power.push_back(static_cast<double>(disc * environment_->power()));
  if (power.empty()) return;
  const double sum = std::accumulate(power.begin(), power.end(), 0.0), even = 1.0 / static_cast<double>(power.size());
  for (double& p : power) p = 0.5 * even + 0.5 * (sum > 0 ? p / sum : even);
  choice_ = PiecewiseConstant1D(power);
}

LightDraw Lights::draw(float choose, const glm::vec2& u) const noexcept {
  LightDraw d{choice_.size() < 2 ? 0 : choice_.sample(choose).cell, u, {}, {}};
  if (is_environment(d.light)) {
    d.row = environment_->draw_row(u.y);
    environment_->prefetch(d.row, u.x);
  }
  return d;
}

void Lights::finish(LightDraw& draw) const noexcept {
  if (!is_environment(draw.light)) return;
  draw.sky = environment_->draw(draw.row, draw.u.x);
  environment_->prefetch(draw.sky.patch);
}

LightSample Lights::sample(const LightDraw& draw, const Vec3f& point) const noexcept {
  LightSample s;
  if (empty()) return s;
  if (draw.light < areas_.size()) {
    s = sample_area(areas_[draw.light], point, draw.u);
  } else if (is_environment(draw.light)) {
    s.direction = environment_->sample(draw.sky, s.pdf, s.radiance);
    s.distance = std::numeric_limits<float>::infinity();
  } else {
    const DirectionalLight& d = directional_[draw.light - areas_.size()];
    s = {d.to_light, std::numeric_limits<float>::infinity(), d.irradiance, 1, true};
  }
  s.pdf *= choice_.probability(draw.light);
  return s;
}

LightSample Lights::sample_area(const Area& light, const Vec3f& point, const glm::vec2& u) const noexcept {
  LightSample s;
  const PiecewiseConstant1D::Draw draw = light.triangles.sample(u.x);
  const Vec3f* corner = &light.corners[3 * draw.cell];
  // what is left of u.x within the triangle's share is uniform again
  const float within = draw.x * static_cast<float>(light.triangles.size()) - static_cast<float>(draw.cell);
  const float root = std::sqrt(std::clamp(within, 0.0f, 1.0f)), b = root * (1 - u.y), c = root * u.y;  // Turk 1990
  const Vec3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const Vec3f to = corner[0] + e1 * b + e2 * c - point;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return s;
  s.distance = std::sqrt(distance2);
  s.direction = to / s.distance;
  const Vec3f normal = glm::cross(e1, e2);
  const float cosine = -glm::dot(normal, s.direction) / glm::length(normal);
  if (!(cosine > 0)) return s;
  s.radiance = light.radiance;
  s.pdf = distance2 / (cosine * light.area);
  return s;
}

Vec3f Lights::area(std::uint32_t i, float cosine, float distance, float& pdf) const noexcept {
  pdf = 0;
  if (!(cosine > 0)) return Vec3f(0);
  pdf = distance * distance / (cosine * areas_[i].area) * choice_.probability(i);
  return areas_[i].radiance;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Camera, film, paths, and light from afar.
#include "scene/read_parts.h"

#include <glm/geometric.hpp>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;
constexpr Bounds radiance_bounds{0, 1e9};
constexpr Bounds angle_bounds{-3600, 3600};

SkyLamp read_lamp(const JsonPlace& p) {
  p.allow({"direction", "size", "shape", "radiance"});
  SkyLamp lamp;
  lamp.direction = p.at("direction").unit_vector();
  if (const auto size = p.find("size")) {
    constexpr Bounds sizes{0.5, 170};
    if (size->is_array()) {
      const auto parts = size->elements();
      if (parts.size() != 2) size->fail("has " + std::to_string(parts.size()) + " elements, 2 are expected: width and height in degrees");
      lamp.width = parts[0].number(sizes);
      lamp.height = parts[1].number(sizes);
    } else {
      lamp.width = lamp.height = size->number(sizes);
    }
  }
  if (const auto shape = p.find("shape")) lamp.round = shape->choice({"rectangle", "disc"}) == 1;
  lamp.radiance = p.colour_or("radiance", lamp.radiance, radiance_bounds);
  return lamp;
}

SkyEnvironment read_sky(const JsonPlace& p) {
  p.allow({"type", "zenith", "horizon", "ground", "lamps", "width", "rotation"});
  SkyEnvironment result;
  SkyDescription& sky = result.sky;
  sky.zenith = p.colour_or("zenith", sky.zenith, radiance_bounds);
  sky.horizon = p.colour_or("horizon", sky.horizon, radiance_bounds);
  sky.ground = p.colour_or("ground", sky.ground, radiance_bounds);
  sky.width = p.integer_or("width", sky.width, 8, 8192);
  if (sky.width % 2 != 0) p.at("width").fail("is " + std::to_string(sky.width) + ", allowed are even numbers");
  if (const auto lamps = p.find("lamps")) {
    const auto all = lamps->elements();
    if (all.size() > 64) lamps->fail("has " + std::to_string(all.size()) + " lamps, at most 64 are allowed", ErrorCode::limit_exceeded);
    for (const JsonPlace& lamp : all) sky.lamps.push_back(read_lamp(lamp));
  }
  result.turn = p.number_or("rotation", 0, angle_bounds) * degree;
  return result;
}

}  // namespace

CameraDescription read_camera(const JsonPlace& p) {
  p.allow({"position", "target", "up", "fov"});
  CameraDescription c;
  c.position = p.at("position").vector();
  c.target = p.at("target").vector();
  c.up = p.vector_or("up", c.up);
  c.fov = p.number_or("fov", c.fov, {0.01, 175});
  const Vec3f view = c.target - c.position;
  if (!(glm::length(view) > 0)) p.at("target").fail("is the camera's position");
  if (!(glm::length(glm::cross(view, c.up)) > 1e-6f * glm::length(view) * glm::length(c.up))) p.fail("'up' is along the view");
  return c;
}

FilmDescription read_film(const JsonPlace& p, const SceneLimits& limits) {
  p.allow({"width", "height"});
  FilmDescription f;
  f.width = p.at("width").integer(1, limits.max_side);
  f.height = p.at("height").integer(1, limits.max_side);
  const std::uint64_t pixels = static_cast<std::uint64_t>(f.width) * static_cast<std::uint64_t>(f.height);
  if (pixels > limits.max_pixels) {
    p.fail("has " + std::to_string(pixels) + " pixels, the limit is " + std::to_string(limits.max_pixels), ErrorCode::limit_exceeded);
  }
  return f;
}

PathDescription read_path(const JsonPlace& p) {
  p.allow({"max_depth", "roulette_depth"});
  PathDescription d;
  d.max_depth = p.integer_or("max_depth", d.max_depth, 1, 1024);
  d.roulette_depth = p.integer_or("roulette_depth", d.roulette_depth, 1, 1024);
  return d;
}

EnvironmentDescription read_environment(const JsonPlace& p) {
  EnvironmentDescription e;
  e.place = p.place();
  switch (p.at("type").choice({"constant", "map", "sky"})) {
    case 0:
      p.allow({"type", "radiance"});
      e.what = ConstantEnvironment{p.at("radiance").colour(radiance_bounds)};
      break;
    case 1:
      p.allow({"type", "file", "scale", "rotation"});
      e.what = EnvironmentMap{p.at("file").text(), p.number_or("scale", 1, {0, 1e6}), p.number_or("rotation", 0, angle_bounds) * degree};
      break;
    default: e.what = read_sky(p);
  }
  return e;
}

DirectionalLight read_light(const JsonPlace& p) {
  p.allow({"type", "direction", "irradiance"});
  (void)p.at("type").choice({"directional"});
  DirectionalLight light;
  light.to_light = -p.at("direction").unit_vector();
  light.irradiance = p.at("irradiance").colour(radiance_bounds);
  return light;
}

}  // namespace brdf::render

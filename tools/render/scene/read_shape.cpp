// SPDX-License-Identifier: Apache-2.0
#include "ingest/printable_text.h"
#include "scene/read_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace brdf::render {
namespace {

constexpr Bounds coordinates{-1e6, 1e6}, sizes{1e-6, 1e6};
constexpr int max_segments = 2048;

NoiseOptions read_noise(const JsonPlace& p) {
  NoiseOptions n;
  n.amplitude = p.number_or("amplitude", n.amplitude, {-0.9, 0.9});
  n.frequency = p.number_or("frequency", n.frequency, {1e-3, 1e4});
  n.octaves = p.integer_or("octaves", n.octaves, 1, 8);
  n.seed = static_cast<std::uint32_t>(p.integer_or("seed", static_cast<int>(n.seed), 0, 1 << 30));
  return n;
}

LatheShape read_lathe(const JsonPlace& p) {
  LatheShape lathe;
  const JsonPlace profile = p.at("profile");
  const auto points = profile.elements();
  if (points.size() < 2 || points.size() > 4096) profile.fail("has " + std::to_string(points.size()) + " points, allowed is 2 to 4096");
  for (const JsonPlace& point : points) {
    const auto parts = point.elements();
    if (parts.size() != 2) point.fail("has " + std::to_string(parts.size()) + " elements, 2 are expected: radius and height");
    lathe.profile.emplace_back(parts[0].number({0, 1e6}), parts[1].number(coordinates));
  }
  lathe.segments = p.integer_or("segments", lathe.segments, 3, max_segments);
  return lathe;
}

QuadShape read_quad(const JsonPlace& p) {
  QuadShape q;
  q.corner = p.vector_or("corner", q.corner);
  q.edge_u = p.vector_or("edge_u", q.edge_u);
  q.edge_v = p.vector_or("edge_v", q.edge_v);
  if (!(glm::length(glm::cross(q.edge_u, q.edge_v)) > 0)) p.fail("the edges span no area");
  return q;
}

}  // namespace

glm::mat4 read_transform(const JsonPlace& p) {
  glm::mat4 matrix(1);
  const auto steps = p.elements();
  if (steps.size() > 64) p.fail("has " + std::to_string(steps.size()) + " steps, at most 64 are allowed");
  for (const JsonPlace& step : steps) {
    step.allow({"scale", "rotate", "degrees", "translate"});
    if (step.has("scale") + step.has("rotate") + step.has("translate") != 1) step.fail("is not one of scale, rotate, translate");
    if (step.has("degrees") != step.has("rotate")) step.fail("'degrees' belongs to 'rotate', which needs it");
    glm::mat4 one(1);
    if (const auto scale = step.find("scale")) {
      const Vec3f s = scale->colour({-1e6, 1e6});
      if (!(std::min({std::abs(s.x), std::abs(s.y), std::abs(s.z)}) > 1e-9f)) scale->fail("makes things flat");
      one = glm::scale(one, s);
    } else if (const auto rotate = step.find("rotate")) {
      const float angle = step.at("degrees").number({-3600, 3600}) * std::numbers::pi_v<float> / 180;
      one = glm::rotate(one, angle, rotate->unit_vector());
    } else {
      one = glm::translate(one, step.at("translate").vector());
    }
    matrix = one * matrix;
  }
  return matrix;
}

ShapeDescription read_shape(const JsonPlace& p, const std::vector<MaterialDescription>& materials, const SceneLimits&) {
  ShapeDescription s;
  s.place = p.place();
  switch (p.at("type").choice({"obj", "ply", "sphere", "quad", "box", "lathe", "blob", "terrain"})) {
    case 0:
    case 1:
      p.allow({"type", "material", "emission", "transform", "flat", "file"});
      s.what = MeshFileShape{p.at("file").text()};
      break;
    case 2:
      p.allow({"type", "material", "transform", "centre", "radius"});
      s.what = SphereShape{p.vector_or("centre", Vec3f(0)), p.number_or("radius", 1, sizes)};
      break;
    case 3:
      p.allow({"type", "material", "emission", "transform", "corner", "edge_u", "edge_v"});
      s.what = read_quad(p);
      break;
    case 4:
      p.allow({"type", "material", "emission", "transform"});
      s.what = BoxShape{};
      break;
    case 5:
      p.allow({"type", "material", "emission", "transform", "flat", "profile", "segments"});
      s.what = read_lathe(p);
      break;
    case 6:
      p.allow({"type", "material", "emission", "transform", "flat", "segments", "amplitude", "frequency", "octaves", "seed"});
      s.what = BlobShape{p.integer_or("segments", 128, 3, max_segments), read_noise(p)};
      break;
    default:
      p.allow({"type", "material", "emission", "transform", "flat", "segments", "amplitude", "frequency", "octaves", "seed"});
      s.what = TerrainShape{p.integer_or("segments", 128, 1, max_segments), read_noise(p)};
  }
  const JsonPlace material = p.at("material");
  const std::string name = material.text();
  const auto found = std::find_if(materials.begin(), materials.end(), [&name](const MaterialDescription& m) { return m.name == name; });
  if (found == materials.end()) material.fail("no material is called " + ingest::in_quotes(name));
  s.material = static_cast<std::uint32_t>(found - materials.begin());
  if (const auto emission = p.find("emission")) s.emission = emission->colour({0, 1e9});
  if (const auto transform = p.find("transform")) {
    s.transform = read_transform(*transform);
    s.has_transform = true;
  }
  s.flat = p.boolean_or("flat", false);
  return s;
}

}  // namespace brdf::render

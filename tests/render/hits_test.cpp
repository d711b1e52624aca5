// SPDX-License-Identifier: Apache-2.0
// Frames and places where rays meet shapes.
#include "path/random.h"
#include "scene/geometry_store.h"
#include "shape/generators.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <span>

namespace brdf::render {
namespace {

void expect_frame(const Hit& hit) {
  EXPECT_NEAR(glm::length(hit.normal), 1, 1e-5f);
  EXPECT_NEAR(glm::length(hit.tangent), 1, 1e-5f);
  EXPECT_NEAR(glm::length(hit.bitangent), 1, 1e-5f);
  EXPECT_NEAR(glm::length(hit.facet), 1, 1e-5f);
  EXPECT_NEAR(glm::dot(hit.normal, hit.tangent), 0, 1e-5f);
  EXPECT_NEAR(glm::dot(hit.normal, hit.bitangent), 0, 1e-5f);
  EXPECT_NEAR(glm::dot(glm::cross(hit.tangent, hit.bitangent), hit.normal), 1, 1e-5f);  // right-handed
  EXPECT_GT(glm::dot(hit.facet, hit.normal), 0);
}

Vec3f random_direction(Random& random) {
  for (;;) {
    const Vec3f v = random.next3() * 2.0f - 1.0f;
    const float length = glm::length(v);
    if (length > 0.1f && length < 1) return v / length;
  }
}

bool meets(const GeometryStore& store, const Ray& ray, Hit& hit) {
  const Intersection met = store.intersect(ray);
  if (met.is_hit()) hit = store.hit(ray, met);
  return met.is_hit();
}

/// Rays towards the middle of a shape of radius 1 or so.
template <class Check>
void shoot(GeometryStore& store, Check&& check) {
  store.commit();
  Random random(1, 1, 1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3f from = random_direction(random) * 5.0f, to = random_direction(random) * 0.3f;
    Hit hit;
    if (!meets(store, {from, glm::normalize(to - from)}, hit)) continue;
    ++hits;
    expect_frame(hit);
    EXPECT_NEAR(glm::length(from + glm::normalize(to - from) * hit.distance - hit.point), 0, 1e-4f);
    check(hit);
  }
  EXPECT_GT(hits, 1500);
}

TEST(Hits, OnASphereHaveItsNormal) {
  GeometryStore store;
  store.add_sphere({0.1f, 0.2f, -0.1f}, 1.2f);
  shoot(store, [](const Hit& hit) {
    const Vec3f radius = hit.point - Vec3f(0.1f, 0.2f, -0.1f);
    EXPECT_NEAR(glm::length(radius), 1.2f, 1e-5f);
    EXPECT_NEAR(glm::dot(hit.normal, radius) / 1.2f, 1, 1e-5f);
  });
}

TEST(Hits, FromWithinASphereAreFound) {
  GeometryStore store;
  store.add_sphere(Vec3f(0), 1);
  store.commit();
  Random random(2, 0, 0);
  for (int i = 0; i < 500; ++i) {
    Hit hit;
    const Vec3f start = random_direction(random), inward = glm::normalize(random_direction(random) * 0.9f - start);
    ASSERT_TRUE(meets(store, {offset_point(start, start, inward), inward}, hit));
    EXPECT_GT(hit.distance, 0.01f) << "met itself";
    EXPECT_NEAR(glm::dot(hit.normal, hit.point), 1, 1e-4f);
  }
}

TEST(Hits, OnAFineBlobAreNearlyThoseOfASphere) {
  GeometryStore store;
  store.add(make_blob(96, {}), false);
  EXPECT_EQ(store.triangles(), 96U * 192U * 2U - 2U * 192U);
  shoot(store, [](const Hit& hit) {
    EXPECT_GT(glm::dot(hit.normal, glm::normalize(hit.point)), 0.99999f);
    if (std::abs(hit.point.y) < 0.9f) {  // u runs round the axis
      const Vec3f round = glm::normalize(Vec3f(hit.point.z, 0, -hit.point.x));
      EXPECT_GT(glm::dot(hit.tangent, round), 0.99f);
    }
  });
}

TEST(Hits, OnAMeshWithoutCoordinatesHaveAStableFrame) {
  Mesh mesh = make_blob(24, {0.2f, 2, 2, 3});
  mesh.uvs.clear();
  mesh.normals.clear();
  GeometryStore store;
  store.add(mesh, false);
  shoot(store, [](const Hit&) {});
}

TEST(Hits, OfAPacketAreThoseOfItsRays) {
  GeometryStore store;
  store.add(make_blob(48, {0.3f, 2, 3, 5}), false);
  store.add_sphere({1.4f, 0, 0}, 0.5f);
  store.commit();
  Random random(6, 0, 0);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const std::size_t count = 1 + static_cast<std::size_t>(i) % GeometryStore::packet;
    std::array<Ray, GeometryStore::packet> rays;
    std::array<Intersection, GeometryStore::packet> met;
    const Vec3f from = random_direction(random) * 4.0f;
    for (Ray& r : rays) r = {from, glm::normalize(random_direction(random) * 1.5f - from)};
    store.intersect(std::span(rays).first(count), met);
    for (std::size_t k = 0; k < count; ++k) {
      const Intersection single = store.intersect(rays[k]);
      ASSERT_EQ(met[k].shape, single.shape);
      if (!single.is_hit()) continue;
      ++hits;
      EXPECT_NEAR(met[k].distance, single.distance, 1e-4f);
      EXPECT_NEAR(glm::length(store.hit(rays[k], met[k]).point - store.hit(rays[k], single).point), 0, 1e-4f);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(Hits, WithoutTangentsHaveTheSameNormals) {
  GeometryStore store;
  store.add(make_blob(24, {0.2f, 2, 2, 3}), false);
  store.commit();
  const Ray ray{{0.3f, 0.2f, 4}, {0, 0, -1}};
  const Intersection met = store.intersect(ray);
  ASSERT_TRUE(met.is_hit());
  const Hit with = store.hit(ray, met), without = store.hit(ray, met, false);
  expect_frame(without);
  EXPECT_EQ(with.normal, without.normal);
  EXPECT_NE(with.tangent, without.tangent);
}

TEST(Hits, FlatMeshesShowTheirFacets) {
  GeometryStore store;
  store.add(make_blob(12, {}), true);
  shoot(store, [](const Hit& hit) { EXPECT_NEAR(glm::dot(hit.normal, hit.facet), 1, 1e-5f); });
}

TEST(Hits, AQuadHasItsTangentAlongU) {
  GeometryStore store;
  store.add(make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), false);
  store.commit();
  Hit hit;
  ASSERT_TRUE(meets(store, {{0.3f, 2, 0.2f}, {0, -1, 0}}, hit));
  EXPECT_NEAR(hit.distance, 2, 1e-6f);
  EXPECT_NEAR(hit.normal.y, 1, 1e-6f);
  EXPECT_NEAR(hit.tangent.x, 1, 1e-6f);
  EXPECT_FALSE(meets(store, {{3, 2, 0}, {0, -1, 0}}, hit));
  EXPECT_TRUE(store.occluded({{0, 2, 0}, {0, -1, 0}}, 3));
  EXPECT_FALSE(store.occluded({{0, 2, 0}, {0, -1, 0}}, 1.9f));
}

TEST(Hits, NextRaysDoNotMeetTheFacetTheyStartFrom) {
  GeometryStore store;
  store.add(make_quad({-1e3f, 7, 1e3f}, {2e3f, 0, 0}, {0, 0.3f, -2e3f}), false);
  store.commit();
  Random random(4, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3f from(200 * random.next() - 100, 300, 200 * random.next() - 100);
    Hit hit, again;
    ASSERT_TRUE(meets(store, {from, glm::normalize(Vec3f(random.next() - 0.5f, -1, random.next() - 0.5f))}, hit));
    Vec3f on = random_direction(random);
    if (glm::dot(on, hit.facet) < 0) on = -on;
    EXPECT_FALSE(meets(store, {offset_point(hit.point, hit.facet, on), on}, again));
  }
}

TEST(Generators, EveryNormalLooksOutwards) {
  for (const Mesh& mesh : {make_box(), make_lathe({{0, -1}, {0.8f, -1}, {1, 0}, {0.7f, 1}, {0, 1}}, 16), make_blob(8, {0.1f, 3, 2, 1})}) {
    for (const glm::uvec3& t : mesh.triangles) {
      const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z], facet = glm::cross(b - a, c - a);
      EXPECT_GT(glm::dot(facet, a + b + c), 0);
      for (int k = 0; k < 3; ++k) EXPECT_GT(glm::dot(facet, mesh.normals[t[k]]), 0);
    }
  }
}

TEST(Generators, AMirroredMeshStillFacesOutwards) {
  Mesh mesh = make_box();
  transform_mesh(mesh, glm::scale(glm::mat4(1), Vec3f(-2, 1, 3)));
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec3f a = mesh.positions[t.x], facet = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    EXPECT_GT(glm::dot(facet, a), 0);
    EXPECT_GT(glm::dot(facet, mesh.normals[t.x]), 0);
  }
}

}  // namespace
}  // namespace brdf::render

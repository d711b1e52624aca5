// SPDX-License-Identifier: Apache-2.0
// The shapes of a scene as rays meet them.
#pragma once

#include "shape/mesh.h"

#include <brdf/direction.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

struct RTCSceneTy;

namespace brdf::render {

struct Ray {
  Vec3f origin{0}, direction{0, 0, 1};  ///< direction has length 1
};

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// Where a ray met a shape. The frame (tangent, bitangent, normal) is orthonormal and right-handed; `normal` is the shading
/// normal, `facet` that of the geometry itself. Both point to the shape's front.
struct Hit {
  float distance = 0;
  Vec3f point{0}, facet{0}, normal{0}, tangent{0}, bitangent{0};
  std::uint32_t shape = no_index;
};

/// Meshes and spheres in an Embree scene with their shading data. Filled, then committed, then immutable and thread-safe.
class GeometryStore {
 public:
  /// Throws Error(unsupported) where Embree cannot run.
  GeometryStore();
  ~GeometryStore();
  GeometryStore(GeometryStore&&) noexcept;
  GeometryStore& operator=(GeometryStore&&) noexcept;

  /// Adds a shape and returns its number, counted from 0. `flat`: the facets' own normals, whatever the mesh says; a mesh
  /// without normals gets smooth ones otherwise. Throws Error(limit_exceeded) when memory runs out.
  std::uint32_t add(const Mesh& mesh, bool flat);
  std::uint32_t add_sphere(const Vec3f& centre, float radius);
  void commit();

  bool intersect(const Ray& ray, Hit& hit) const noexcept;
  /// Whether anything lies between the origin and `distance` along the ray.
  bool occluded(const Ray& ray, float distance) const noexcept;

  std::uint64_t triangles() const noexcept { return triangles_.size(); }
  Vec3f centre() const noexcept { return 0.5f * (low_ + high_); }
  float radius() const noexcept;  ///< of a ball around everything
  RTCSceneTy* embree_scene() const noexcept;

 private:
  /// What a hit needs besides Embree's answer, together in memory.
  struct Triangle {
    Vec3f p0, e1, e2, n0, n1, n2;
  };
  struct Shape {
    std::uint32_t first = 0;           ///< triangle
    std::uint32_t first_tangent = no_index;  ///< three per triangle; none: a frame made of the normal
    float radius = 0;                  ///< of a sphere; 0: a mesh
    Vec3f centre{0};
  };
  struct Handles;

  void grow(const Vec3f& p);

  std::unique_ptr<Handles> handles_;
  std::vector<Triangle> triangles_;
  std::vector<Vec3f> tangents_;
  std::vector<Shape> shapes_;
  Vec3f low_{0}, high_{0};
  bool is_empty_ = true;
};

/// `point` moved off the surface to the side of `direction`, far enough that a ray from there cannot meet the same facet
/// (Waechter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6).
Vec3f offset_point(const Vec3f& point, const Vec3f& facet, const Vec3f& direction) noexcept;

/// Tangent and bitangent to a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
void make_frame(const Vec3f& normal, Vec3f& tangent, Vec3f& bitangent) noexcept;

}  // namespace brdf::render

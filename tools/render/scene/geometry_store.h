// SPDX-License-Identifier: Apache-2.0
// The shapes of a scene as rays meet them.
#pragma once

#include "memory/large_pages.h"
#include "shape/mesh.h"

#include <brdf/direction.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

struct RTCSceneTy;

namespace brdf::render {

struct Ray {
  Vec3f origin{0}, direction{0, 0, 1};  ///< direction has length 1
};

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

/// Embree's answer for a ray; `shape` is no_index where it met none.
struct Intersection {
  float distance = 0, u = 0, v = 0;
  std::uint32_t shape = no_index, primitive = 0;
  bool is_hit() const noexcept { return shape != no_index; }
};

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

  Intersection intersect(const Ray& ray) const noexcept;
  /// The same for at most `packet` rays that start close together and go much the same way, in less time.
  static constexpr std::size_t packet = 8;
  void intersect(std::span<const Ray> rays, std::span<Intersection> met) const noexcept;

  /// What there is to know where `ray` met something. Without `tangents` those of the mesh are not looked up, and the frame
  /// follows from the normal alone.
  Hit hit(const Ray& ray, const Intersection& met, bool tangents = true) const noexcept;
  /// Brings to the caches what `hit` will read.
  void prefetch(const Intersection& met) const noexcept;

  /// Whether anything lies between the origin and `distance` along the ray.
  bool occluded(const Ray& ray, float distance) const noexcept;

  std::uint64_t triangles() const noexcept { return triangles_.size(); }
  Vec3f centre() const noexcept { return 0.5f * (low_ + high_); }
  float radius() const noexcept;  ///< of a ball around everything
  RTCSceneTy* embree_scene() const noexcept;

 private:
  /// A unit vector with 21 bits a component: off by less than 5e-7.
  class PackedNormal {
   public:
    explicit PackedNormal(const Vec3f& n) noexcept;
    Vec3f unpack() const noexcept;

   private:
    std::uint64_t bits_;
  };
  /// What a hit needs besides Embree's answer, in one line of the cache.
  struct alignas(64) Triangle {
    Vec3f p0, e1, e2;
    PackedNormal n0, n1, n2;
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
  std::vector<Triangle, LargePages<Triangle>> triangles_;
  std::vector<Vec3f, LargePages<Vec3f>> tangents_;
  std::vector<Shape> shapes_;
  Vec3f low_{0}, high_{0};
  bool is_empty_ = true;
  bool has_packets_ = false;  ///< Embree has them for this processor
};

/// `point` moved off the surface to the side of `direction`, far enough that a ray from there cannot meet the same facet
/// (Waechter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6).
Vec3f offset_point(const Vec3f& point, const Vec3f& facet, const Vec3f& direction) noexcept;

/// Tangent and bitangent to a unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
void make_frame(const Vec3f& normal, Vec3f& tangent, Vec3f& bitangent) noexcept;

}  // namespace brdf::render

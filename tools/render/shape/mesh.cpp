// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh.h"

#include <brdf/error.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace brdf::render {
namespace {

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Angle between two vectors that need not have length 1, exact for small ones, too (Kahan).
float angle_between(const Vec3f& a, const Vec3f& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); }

Vec3f normalized_or_zero(const Vec3f& v) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length) ? v / length : Vec3f(0);
}

}  // namespace

void check_mesh(Mesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) throw Error(ErrorCode::no_data, name + ": the mesh has no triangle");
  const std::size_t vertices = mesh.positions.size();
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!is_finite(mesh.positions[i])) {
      throw Error(ErrorCode::malformed, name + ": vertex " + std::to_string(i) + " has a coordinate that is not finite");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const std::size_t largest = std::max({t.x, t.y, t.z});
    if (largest >= vertices) {
      throw Error(ErrorCode::malformed, name + ": triangle " + std::to_string(i) + " names vertex " + std::to_string(largest) +
                                            ", the mesh has " + std::to_string(vertices));
    }
  }
  for (const glm::vec2& uv : mesh.uvs) {
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
      throw Error(ErrorCode::malformed, name + ": a texture coordinate is not finite");
    }
  }
  if (mesh.normals.empty()) return;
  std::vector<Vec3f> smooth;
  for (std::size_t i = 0; i < vertices; ++i) {
    if (!is_finite(mesh.normals[i])) {
      throw Error(ErrorCode::malformed, name + ": the normal of vertex " + std::to_string(i) + " is not finite");
    }
    mesh.normals[i] = normalized_or_zero(mesh.normals[i]);
    if (mesh.normals[i] != Vec3f(0)) continue;
    if (smooth.empty()) smooth = smooth_normals(mesh);
    mesh.normals[i] = smooth[i];
  }
}

std::vector<Vec3f> smooth_normals(const Mesh& mesh) {
  std::vector<Vec3f> normals(mesh.positions.size(), Vec3f(0));
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec3f corner[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const Vec3f normal = normalized_or_zero(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    for (int k = 0; k < 3; ++k) {
      const Vec3f &here = corner[k], &next = corner[(k + 1) % 3], &last = corner[(k + 2) % 3];
      normals[t[k]] += normal * angle_between(next - here, last - here);
    }
  }
  for (Vec3f& n : normals) {
    n = normalized_or_zero(n);
    if (n == Vec3f(0)) n = Vec3f(0, 0, 1);  // of a vertex that only degenerate triangles have: never seen
  }
  return normals;
}

void transform_mesh(Mesh& mesh, const glm::mat4& matrix) {
  const glm::mat3 linear(matrix);
  const glm::mat3 of_normals = glm::transpose(glm::inverse(linear));
  for (Vec3f& p : mesh.positions) p = Vec3f(matrix * glm::vec4(p, 1));
  for (Vec3f& n : mesh.normals) n = normalized_or_zero(of_normals * n);
  if (glm::determinant(linear) < 0) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  }
}

std::vector<Vec3f> vertex_tangents(const Mesh& mesh, const std::vector<Vec3f>& normals) {
  std::vector<Vec3f> tangents(mesh.positions.size(), Vec3f(0));
  if (mesh.uvs.empty()) return tangents;
  for (const glm::uvec3& t : mesh.triangles) {
    const Vec3f e1 = mesh.positions[t.y] - mesh.positions[t.x], e2 = mesh.positions[t.z] - mesh.positions[t.x];
    const glm::vec2 d1 = mesh.uvs[t.y] - mesh.uvs[t.x], d2 = mesh.uvs[t.z] - mesh.uvs[t.x];
    const float determinant = d1.x * d2.y - d2.x * d1.y;
    if (determinant == 0 || !std::isfinite(determinant)) continue;
    // dp/du, weighted by the triangle's area
    const Vec3f along = normalized_or_zero((e1 * d2.y - e2 * d1.y) / determinant) * glm::length(glm::cross(e1, e2));
    for (int k = 0; k < 3; ++k) tangents[t[k]] += along;
  }
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    tangents[i] = normalized_or_zero(tangents[i] - normals[i] * glm::dot(normals[i], tangents[i]));
  }
  return tangents;
}

}  // namespace brdf::render

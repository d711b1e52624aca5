// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as readers and generators make it, before it is packed for rendering.
#pragma once

#include <brdf/direction.h>

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace brdf::render {

/// Counter-clockwise triangles, seen from the side to which their normals point. `normals` and `uvs` have one entry per
/// position or none at all.
struct Mesh {
  std::vector<Vec3f> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::uvec3> triangles;
};

/// What readers and generators may make. A file from outside cannot ask for more than this.
struct MeshLimits {
  std::uint64_t max_file_bytes = std::uint64_t{1} << 30;
  std::uint64_t max_vertices = std::uint64_t{1} << 25;
  std::uint64_t max_triangles = std::uint64_t{1} << 25;
};

/// Throws Error(malformed | no_data), the sentence begins with `name`: no triangle, an index beyond the vertices, a number
/// that is not finite. Normals that are zero are replaced by those of the vertex's triangles.
void check_mesh(Mesh& mesh, const std::string& name);

/// Normals of length 1, weighted by the angle of each triangle at the vertex (Thuermer and Wuethrich 1998), which unlike the
/// area does not depend on how a polygon was cut.
std::vector<Vec3f> smooth_normals(const Mesh& mesh);

/// Positions by `matrix`, normals by its inverse transpose; a mirroring turns the triangles round, so that they keep facing
/// the way they did. The matrix must be affine and invertible.
void transform_mesh(Mesh& mesh, const glm::mat4& matrix);

/// Tangents along increasing u for each vertex, orthogonal to its normal; zero where the mesh has no or degenerate uvs.
/// `normals` has one entry per vertex.
std::vector<Vec3f> vertex_tangents(const Mesh& mesh, const std::vector<Vec3f>& normals);

}  // namespace brdf::render

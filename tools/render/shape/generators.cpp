// SPDX-License-Identifier: Apache-2.0
#include "shape/generators.h"

#include "shape/lattice_noise.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Triangles of a grid of (columns + 1) x (rows + 1) vertices, row by row from vertex `first` on. Its normals are along
/// (direction of columns) x (direction of rows).
void add_grid_triangles(Mesh& mesh, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  const std::uint32_t stride = columns + 1;
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = first + j * stride + i, b = a + 1, c = a + stride, d = c + 1;
      mesh.triangles.emplace_back(a, b, d);
      mesh.triangles.emplace_back(a, d, c);
    }
  }
}

void add_quad(Mesh& mesh, const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3f normal = glm::normalize(glm::cross(edge_u, edge_v));
  for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
    mesh.positions.push_back(corner + edge_u * uv.x + edge_v * uv.y);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
  }
  add_grid_triangles(mesh, first, 1, 1);
}

/// Removes triangles without area, such as those at poles.
void drop_degenerate(Mesh& mesh) {
  std::erase_if(mesh.triangles, [&mesh](const glm::uvec3& t) {
    const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    return a == b || b == c || c == a;
  });
}

}  // namespace

Mesh make_quad(const Vec3f& corner, const Vec3f& edge_u, const Vec3f& edge_v) {
  Mesh mesh;
  add_quad(mesh, corner, edge_u, edge_v);
  return mesh;
}

Mesh make_box() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Vec3f n(0), u(0), v(0);
      n[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1;
      add_quad(mesh, n - u - v, u * 2.0f, v * 2.0f);
    }
  }
  return mesh;
}

Mesh make_lathe(const std::vector<glm::vec2>& profile, int segments) {
  Mesh mesh;
  const float crease = std::cos(30 * pi / 180);
  const auto columns = static_cast<std::uint32_t>(segments);
  const auto outward = [&profile](std::size_t k) {  // of the piece from point k to k + 1: its direction turned to the right
    const glm::vec2 d = profile[k + 1] - profile[k];
    const float length = glm::length(d);
    return length > 0 ? glm::vec2(d.y, -d.x) / length : glm::vec2(1, 0);
  };
  const auto mean = [crease](const glm::vec2& here, const glm::vec2& other) {
    return glm::dot(here, other) > crease ? glm::normalize(here + other) : here;
  };
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const glm::vec2 here = outward(k);
    const std::array<glm::vec2, 2> normals{k > 0 ? mean(here, outward(k - 1)) : here,
                                           k + 2 < profile.size() ? mean(here, outward(k + 1)) : here};
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t end = 0; end < 2; ++end) {
      const glm::vec2 point = profile[k + end];
      for (std::uint32_t i = 0; i <= columns; ++i) {
        // the seam's last column lies exactly on its first
        const float phi = i == columns ? 0.0f : 2 * pi * static_cast<float>(i) / static_cast<float>(columns);
        const float c = std::cos(phi), s = -std::sin(phi);
        mesh.positions.emplace_back(point.x * c, point.y, point.x * s);
        mesh.normals.emplace_back(normals[end].x * c, normals[end].y, normals[end].x * s);
        mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(columns),
                              static_cast<float>(k + end) / static_cast<float>(profile.size() - 1));
      }
    }
    add_grid_triangles(mesh, first, columns, 1);
  }
  drop_degenerate(mesh);
  return mesh;
}

Mesh make_blob(int segments, const NoiseOptions& noise) {
  Mesh mesh;
  const auto rows = static_cast<std::uint32_t>(segments), columns = 2 * rows;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    const float theta = pi * (1 - static_cast<float>(j) / static_cast<float>(rows));
    const float sine = j == 0 || j == rows ? 0.0f : std::sin(theta);
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const float phi = i == columns ? 0.0f : 2 * pi * static_cast<float>(i) / static_cast<float>(columns);
      const Vec3f n(sine * std::cos(phi), std::cos(theta), -sine * std::sin(phi));
      mesh.positions.push_back(n * (1 + displacement(n, noise)));
      mesh.normals.push_back(n);
      mesh.uvs.emplace_back(static_cast<float>(i) / static_cast<float>(columns), static_cast<float>(j) / static_cast<float>(rows));
    }
  }
  add_grid_triangles(mesh, 0, columns, rows);
  drop_degenerate(mesh);
  if (noise.amplitude == 0) return mesh;
  mesh.normals = smooth_normals(mesh);
  // Vertices of the seam and of the poles are there several times; they must agree, or an edge shows.
  for (std::uint32_t j = 0; j <= rows; ++j) {
    Vec3f &left = mesh.normals[j * (columns + 1)], &right = mesh.normals[j * (columns + 1) + columns];
    left = right = glm::normalize(left + right);
    if (j != 0 && j != rows) continue;
    Vec3f sum(0);
    for (std::uint32_t i = 1; i < columns; ++i) sum += mesh.normals[j * (columns + 1) + i];
    for (std::uint32_t i = 0; i <= columns; ++i) mesh.normals[j * (columns + 1) + i] = glm::normalize(sum);
  }
  return mesh;
}

Mesh make_terrain(int segments, const NoiseOptions& noise) {
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const glm::vec2 uv(static_cast<float>(i) / static_cast<float>(n), static_cast<float>(j) / static_cast<float>(n));
      const Vec3f flat(2 * uv.x - 1, 0, 1 - 2 * uv.y);
      mesh.positions.emplace_back(flat.x, displacement(flat, noise), flat.z);
      mesh.normals.emplace_back(0, 1, 0);
      mesh.uvs.push_back(uv);
    }
  }
  add_grid_triangles(mesh, 0, n, n);
  if (noise.amplitude != 0) mesh.normals = smooth_normals(mesh);
  return mesh;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "shape/ply_writer.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace brdf::render {
namespace {

void put(std::vector<std::byte>& to, std::uint32_t bits) {
  for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<std::byte>(bits >> shift & 0xff));
}

void put(std::vector<std::byte>& to, float value) { put(to, std::bit_cast<std::uint32_t>(value)); }

void put(std::vector<std::byte>& to, const Vec3f& v) {
  for (int k = 0; k < 3; ++k) put(to, v[k]);
}

std::string header_of(const Mesh& mesh) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) + "\n";
  const auto add = [&header](const char* name) { header += std::string("property float ") + name + "\n"; };
  for (const char* name : {"x", "y", "z"}) add(name);
  if (!mesh.normals.empty())
    for (const char* name : {"nx", "ny", "nz"}) add(name);
  if (!mesh.uvs.empty())
    for (const char* name : {"u", "v"}) add(name);
  return header + "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

}  // namespace

std::vector<std::byte> write_ply(const Mesh& mesh) {
  const std::string header = header_of(mesh);
  const std::span<const std::byte> head = std::as_bytes(std::span(header.data(), header.size()));
  std::vector<std::byte> bytes(head.begin(), head.end());
  bytes.reserve(bytes.size() + 32 * mesh.positions.size() + 13 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    put(bytes, mesh.positions[i]);
    if (!mesh.normals.empty()) put(bytes, mesh.normals[i]);
    if (!mesh.uvs.empty()) {
      put(bytes, mesh.uvs[i].x);
      put(bytes, mesh.uvs[i].y);
    }
  }
  for (const glm::uvec3& t : mesh.triangles) {
    bytes.push_back(std::byte{3});
    for (int k = 0; k < 3; ++k) put(bytes, static_cast<std::uint32_t>(t[k]));
  }
  return bytes;
}

}  // namespace brdf::render

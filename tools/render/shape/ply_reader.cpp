// SPDX-License-Identifier: Apache-2.0
#include "shape/ply_reader.h"

#include "ingest/printable_text.h"
#include "shape/mesh_text.h"
#include "shape/ply_header.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace brdf::render {
namespace {

constexpr std::uint64_t max_corners = 65536;  // of one polygon

/// Takes values off the data one after the other.
class ValueStream {
 public:
  ValueStream(std::string_view data, PlyEncoding encoding, const std::string& name)
      : data_(data), encoding_(encoding), name_(name) {}

  double next(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) {
      const std::string_view word = take_word(data_);
      if (word.empty()) end();
      const auto value = number_of<double>(word);
      if (!value) throw Error(ErrorCode::malformed, name_ + ": " + ingest::in_quotes(word) + " is no number");
      return *value;
    }
    std::array<char, 8> raw{};
    const std::size_t size = size_of(type);
    if (data_.size() < size) end();
    std::copy_n(data_.data(), size, raw.begin());
    data_.remove_prefix(size);
    constexpr bool little = std::endian::native == std::endian::little;
    if ((encoding_ == PlyEncoding::little_endian) != little) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
      case PlyType::i8: return as<std::int8_t>(raw);
      case PlyType::u8: return as<std::uint8_t>(raw);
      case PlyType::i16: return as<std::int16_t>(raw);
      case PlyType::u16: return as<std::uint16_t>(raw);
      case PlyType::i32: return as<std::int32_t>(raw);
      case PlyType::u32: return as<std::uint32_t>(raw);
      case PlyType::f32: return static_cast<double>(as<float>(raw));
      case PlyType::f64: return as<double>(raw);
    }
    return 0;
  }

  /// A whole number from 0 to `most`.
  std::uint64_t next_index(PlyType type, std::uint64_t most, const char* what) {
    const double value = next(type);
    if (!(value >= 0 && value <= static_cast<double>(most)) || value != std::floor(value)) {
      throw Error(ErrorCode::malformed,
                  name_ + ": " + what + " is " + std::to_string(value) + ", allowed is 0 to " + std::to_string(most));
    }
    return static_cast<std::uint64_t>(value);
  }

  /// Bytes left; every value takes at least one.
  std::uint64_t left() const noexcept { return data_.size(); }

 private:
  template <class T>
  static T as(const std::array<char, 8>& raw) {
    T value;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  [[noreturn]] void end() const { throw Error(ErrorCode::truncated, name_ + ": the file ends before its last element"); }

  std::string_view data_;
  PlyEncoding encoding_;
  std::string name_;
};

enum Role : int { x, y, z, nx, ny, nz, u, v, role_count };

int role_of(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, int>, 12> names{{{"x", x}, {"y", y}, {"z", z}, {"nx", nx}, {"ny", ny}, {"nz", nz},
                                                                    {"u", u}, {"v", v}, {"s", u}, {"t", v}, {"texture_u", u}, {"texture_v", v}}};
  for (const auto& [known, role] : names)
    if (known == name) return role;
  return role_count;
}

void skip_list(ValueStream& stream, const PlyProperty& p) {
  const std::uint64_t count = stream.next_index(p.count_type, stream.left(), "the length of a list");
  for (std::uint64_t i = 0; i < count; ++i) (void)stream.next(p.type);
}

void read_vertices(ValueStream& stream, const PlyElement& element, Mesh& mesh) {
  std::array<bool, role_count + 1> has{};
  for (const PlyProperty& p : element.properties)
    if (!p.is_list) has[static_cast<std::size_t>(role_of(p.name))] = true;
  const bool normals = has[nx] && has[ny] && has[nz], uvs = has[u] && has[v];
  mesh.positions.reserve(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    std::array<float, role_count + 1> value{};
    for (const PlyProperty& p : element.properties) {
      if (p.is_list) skip_list(stream, p);
      else value[static_cast<std::size_t>(role_of(p.name))] = static_cast<float>(stream.next(p.type));
    }
    mesh.positions.emplace_back(value[x], value[y], value[z]);
    if (normals) mesh.normals.emplace_back(value[nx], value[ny], value[nz]);
    if (uvs) mesh.uvs.emplace_back(value[u], value[v]);
  }
}

void read_faces(ValueStream& stream, const PlyElement& element, Mesh& mesh, const MeshLimits& limits, const std::string& name) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& p : element.properties) {
      const bool corners = p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
      if (!corners) {
        if (p.is_list) skip_list(stream, p);
        else (void)stream.next(p.type);
        continue;
      }
      const std::uint64_t count = stream.next_index(p.count_type, max_corners, "the number of corners of a face");
      if (count < 3) throw Error(ErrorCode::malformed, name + ": face " + std::to_string(i) + " has " + std::to_string(count) + " corners, a face needs 3");
      if (mesh.triangles.size() + count - 2 > limits.max_triangles) {
        throw Error(ErrorCode::limit_exceeded, name + ": more than " + std::to_string(limits.max_triangles) + " triangles");
      }
      std::array<std::uint32_t, 3> fan{};
      for (std::uint64_t k = 0; k < count; ++k) {
        fan[2] = static_cast<std::uint32_t>(stream.next_index(p.type, std::numeric_limits<std::uint32_t>::max(), "an index of a face"));
        if (k >= 2) mesh.triangles.emplace_back(fan[0], fan[1], fan[2]);
        fan[k == 0 ? 0 : 1] = fan[2];
      }
    }
  }
}

void skip_element(ValueStream& stream, const PlyElement& element) {
  if (element.properties.empty()) return;  // takes no bytes, whatever its count
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const PlyProperty& p : element.properties) {
      if (p.is_list) skip_list(stream, p);
      else (void)stream.next(p.type);
    }
  }
}

}  // namespace

Mesh read_ply(std::span<const std::byte> bytes, const std::string& name, const MeshLimits& limits) {
  std::string_view data(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const PlyHeader header = take_ply_header(data, name);
  ValueStream stream(data, header.encoding, name);
  Mesh mesh;
  for (const PlyElement& element : header.elements) {
    const bool vertices = element.name == "vertex", faces = element.name == "face";
    if (vertices && element.count > limits.max_vertices) {
      throw Error(ErrorCode::limit_exceeded, name + ": " + std::to_string(element.count) + " vertices, the limit is " + std::to_string(limits.max_vertices));
    }
    if ((vertices || faces) && element.count > 0 && element.properties.empty()) {
      throw Error(ErrorCode::malformed, name + ": element '" + element.name + "' has no property");
    }
    if (element.count > stream.left() && !element.properties.empty()) {  // before anything is reserved
      throw Error(ErrorCode::truncated, name + ": the file ends before its last element");
    }
    if (vertices) {
      if (!mesh.positions.empty()) throw Error(ErrorCode::malformed, name + ": element 'vertex' comes twice");
      const auto has = [&element](int role) {
        return std::any_of(element.properties.begin(), element.properties.end(), [role](const PlyProperty& p) { return !p.is_list && role_of(p.name) == role; });
      };
      if (!has(x) || !has(y) || !has(z)) throw Error(ErrorCode::malformed, name + ": element 'vertex' lacks x, y or z");
      read_vertices(stream, element, mesh);
    } else if (faces) {
      read_faces(stream, element, mesh, limits, name);
    } else {
      skip_element(stream, element);
    }
  }
  check_mesh(mesh, name);
  return mesh;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "shape/obj_reader.h"

#include "ingest/printable_text.h"
#include "shape/mesh_text.h"

#include <brdf/error.h>

#include <array>
#include <cmath>
#include <unordered_map>

namespace brdf::render {
namespace {

/// Indices of position, texture coordinate and normal of one corner; none is -1.
using Corner = std::array<std::int64_t, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& c) const noexcept {
    std::uint64_t h = 0;
    for (const std::int64_t i : c) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U + (h >> 29);
    return static_cast<std::size_t>(h);
  }
};

class ObjReader {
 public:
  ObjReader(const std::string& name, const MeshLimits& limits) : name_(name), limits_(limits) {}

  Mesh read(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      std::string_view line = take_line(text);
      line = line.substr(0, line.find('#'));
      const std::string_view key = take_word(line);
      if (key == "v") positions_.push_back(vector(line, "v"));
      else if (key == "vn") normals_.push_back(vector(line, "vn"));
      else if (key == "vt") uvs_.push_back(texture_coordinate(line));
      else if (key == "f") face(line);
      if (std::max({positions_.size(), normals_.size(), uvs_.size()}) > limits_.max_vertices) {
        too_many("vertices", limits_.max_vertices);
      }
    }
    if (!every_normal_) mesh_.normals.clear();
    if (!every_uv_) mesh_.uvs.clear();
    check_mesh(mesh_, name_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::malformed, name_ + ":" + std::to_string(line_) + ": " + what);
  }
  [[noreturn]] void too_many(const char* what, std::uint64_t most) const {
    throw Error(ErrorCode::limit_exceeded,
                name_ + ":" + std::to_string(line_) + ": more than " + std::to_string(most) + " " + what);
  }

  float coordinate(std::string_view word, const char* key) const {
    const auto value = number_of<float>(word);
    if (!value || !std::isfinite(*value)) {
      fail("'" + std::string(key) + "' has " + ingest::in_quotes(word) + " where a finite number is expected");
    }
    return *value;
  }

  Vec3f vector(std::string_view line, const char* key) const {
    Vec3f v;
    for (int k = 0; k < 3; ++k) v[k] = coordinate(take_word(line), key);
    return v;
  }

  glm::vec2 texture_coordinate(std::string_view line) const {
    glm::vec2 uv(0);
    uv.x = coordinate(take_word(line), "vt");
    if (const std::string_view word = take_word(line); !word.empty()) uv.y = coordinate(word, "vt");
    return uv;
  }

  /// One part of "1/2/3"; counts from 1, or backwards from the last with negative numbers.
  std::int64_t index(std::string_view part, std::size_t count, const char* what) const {
    const auto value = number_of<std::int64_t>(part);
    const auto size = static_cast<std::int64_t>(count);
    if (!value || *value == 0 || *value > size || *value < -size) {
      fail("face names " + std::string(what) + " " + ingest::in_quotes(part) + ", there are " + std::to_string(count) + " so far");
    }
    return *value > 0 ? *value - 1 : size + *value;
  }

  std::uint32_t vertex(std::string_view word) {
    Corner corner{-1, -1, -1};
    const std::size_t first = word.find('/');
    corner[0] = index(word.substr(0, first), positions_.size(), "vertex");
    if (first != std::string_view::npos) {
      const std::string_view rest = word.substr(first + 1);
      const std::size_t second = rest.find('/');
      if (const auto part = rest.substr(0, second); !part.empty()) corner[1] = index(part, uvs_.size(), "texture coordinate");
      if (second != std::string_view::npos && second + 1 < rest.size()) {
        corner[2] = index(rest.substr(second + 1), normals_.size(), "normal");
      }
    }
    every_uv_ = every_uv_ && corner[1] >= 0;
    every_normal_ = every_normal_ && corner[2] >= 0;
    const auto [place, is_new] = known_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      if (mesh_.positions.size() >= limits_.max_vertices) too_many("vertices", limits_.max_vertices);
      mesh_.positions.push_back(positions_[static_cast<std::size_t>(corner[0])]);
      mesh_.uvs.push_back(corner[1] < 0 ? glm::vec2(0) : uvs_[static_cast<std::size_t>(corner[1])]);
      mesh_.normals.push_back(corner[2] < 0 ? Vec3f(0) : normals_[static_cast<std::size_t>(corner[2])]);
    }
    return place->second;
  }

  void face(std::string_view line) {
    std::uint32_t first = 0, last = 0;
    std::size_t corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
      const std::uint32_t v = vertex(word);
      if (corners == 0) first = v;
      if (corners >= 2) {
        if (mesh_.triangles.size() >= limits_.max_triangles) too_many("triangles", limits_.max_triangles);
        mesh_.triangles.emplace_back(first, last, v);
      }
      last = v;
    }
    if (corners < 3) fail("a face needs at least 3 vertices, this one has " + std::to_string(corners));
  }

  std::string name_;
  MeshLimits limits_;
  std::size_t line_ = 0;
  std::vector<Vec3f> positions_, normals_;
  std::vector<glm::vec2> uvs_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> known_;
  bool every_uv_ = true, every_normal_ = true;
  Mesh mesh_;
};

}  // namespace

Mesh read_obj(std::string_view text, const std::string& name, const MeshLimits& limits) {
  return ObjReader(name, limits).read(text);
}

}  // namespace brdf::render

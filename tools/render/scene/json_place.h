// SPDX-License-Identifier: Apache-2.0
// A value in a JSON file that knows where it is, so that every complaint can say so.
#pragma once

#include <brdf/direction.h>
#include <brdf/error.h>

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace brdf::render {

/// Bounds of a number, both allowed.
struct Bounds {
  double least = -1e6, most = 1e6;
};

/// Refers to a document that must outlive it. Members throw Error(malformed) with file and place.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::ordered_json& value, std::string file, std::string where = "")
      : value_(&value), file_(std::move(file)), where_(std::move(where)) {}

  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::malformed) const;
  /// "scene.json: shapes[2].material"
  std::string place() const { return where_.empty() ? file_ : file_ + ": " + where_; }

  /// Checks that this is an object with these keys alone.
  void allow(std::initializer_list<std::string_view> keys) const;
  bool has(std::string_view key) const;
  JsonPlace at(std::string_view key) const;
  std::optional<JsonPlace> find(std::string_view key) const;
  /// Keys and values of an object, in the order of the file.
  std::vector<std::pair<std::string, JsonPlace>> members() const;
  /// Elements of an array.
  std::vector<JsonPlace> elements() const;
  bool is_array() const { return value_->is_array(); }

  float number(Bounds bounds = {}) const;
  int integer(int least, int most) const;
  std::uint64_t natural(std::uint64_t least) const;
  bool boolean() const;
  std::string text() const;
  /// One of the words; returns its index.
  std::size_t choice(std::initializer_list<std::string_view> words) const;
  Vec3f vector(Bounds bounds = {}) const;
  /// A vector that is not zero, as one of length 1.
  Vec3f unit_vector() const;
  /// Three numbers, or one that stands for three.
  Vec3f colour(Bounds bounds) const;

  // Of an optional member: its value, or what is given.
  float number_or(std::string_view key, float otherwise, Bounds bounds = {}) const;
  int integer_or(std::string_view key, int otherwise, int least, int most) const;
  bool boolean_or(std::string_view key, bool otherwise) const;
  Vec3f vector_or(std::string_view key, const Vec3f& otherwise) const;
  Vec3f colour_or(std::string_view key, const Vec3f& otherwise, Bounds bounds) const;

 private:
  const nlohmann::ordered_json* value_;
  std::string file_, where_;
};

}  // namespace brdf::render

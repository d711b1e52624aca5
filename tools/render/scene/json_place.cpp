// SPDX-License-Identifier: Apache-2.0
#include "scene/json_place.h"

#include "ingest/printable_text.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

namespace brdf::render {
namespace {

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string shown(const Bounds& b) { return shown(b.least) + " to " + shown(b.most); }

std::string listed(std::initializer_list<std::string_view> words) {
  std::string text;
  std::size_t i = 0;
  for (const std::string_view word : words) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += word;
    ++i;
  }
  return text;
}

}  // namespace

void JsonPlace::fail(const std::string& what, ErrorCode code) const { throw Error(code, place() + ": " + what); }

void JsonPlace::allow(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) fail(std::string("is ") + value_->type_name() + ", an object is expected");
  for (const auto& [key, value] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      fail("unknown key " + ingest::in_quotes(key) + ", allowed is " + listed(keys));
    }
  }
}

bool JsonPlace::has(std::string_view key) const { return value_->is_object() && value_->contains(key); }

JsonPlace JsonPlace::at(std::string_view key) const {
  if (!value_->is_object()) fail(std::string("is ") + value_->type_name() + ", an object is expected");
  const auto found = value_->find(key);
  if (found == value_->end()) fail("'" + std::string(key) + "' is missing");
  return {*found, file_, (where_.empty() ? "" : where_ + ".") + std::string(key)};
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return at(key);
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::members() const {
  if (!value_->is_object()) fail(std::string("is ") + value_->type_name() + ", an object is expected");
  std::vector<std::pair<std::string, JsonPlace>> result;
  for (const auto& [key, value] : value_->items()) {
    result.emplace_back(key, JsonPlace(value, file_, (where_.empty() ? "" : where_ + ".") + ingest::printable_text(key, 64)));
  }
  return result;
}

std::vector<JsonPlace> JsonPlace::elements() const {
  if (!value_->is_array()) fail(std::string("is ") + value_->type_name() + ", an array is expected");
  std::vector<JsonPlace> result;
  result.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    result.emplace_back((*value_)[i], file_, where_ + "[" + std::to_string(i) + "]");
  }
  return result;
}

float JsonPlace::number(Bounds bounds) const {
  if (!value_->is_number()) fail(std::string("is ") + value_->type_name() + ", a number is expected");
  const double value = value_->get<double>();
  if (!(value >= bounds.least && value <= bounds.most)) fail("is " + shown(value) + ", allowed is " + shown(bounds));
  return static_cast<float>(value);
}

int JsonPlace::integer(int least, int most) const {
  if (!value_->is_number_integer()) fail(std::string("is ") + (value_->is_number() ? value_->dump() : value_->type_name()) + ", a whole number is expected");
  const bool fits = value_->is_number_unsigned() ? value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(std::max(most, 0))
                                                 : value_->get<std::int64_t>() <= most;
  if (!fits || value_->get<std::int64_t>() < least) {
    fail("is " + value_->dump() + ", allowed is " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value_->get<int>();
}

std::uint64_t JsonPlace::natural(std::uint64_t least) const {
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() < least) {
    fail("is " + ingest::printable_text(value_->dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace), 40) +
         ", allowed is a whole number of at least " + std::to_string(least));
  }
  return value_->get<std::uint64_t>();
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) fail(std::string("is ") + value_->type_name() + ", true or false is expected");
  return value_->get<bool>();
}

std::string JsonPlace::text() const {
  if (!value_->is_string()) fail(std::string("is ") + value_->type_name() + ", a string is expected");
  return value_->get<std::string>();
}

std::size_t JsonPlace::choice(std::initializer_list<std::string_view> words) const {
  const std::string word = text();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) fail("is " + ingest::in_quotes(word) + ", allowed is " + listed(words));
  return static_cast<std::size_t>(found - words.begin());
}

Vec3f JsonPlace::vector(Bounds bounds) const {
  const auto parts = elements();
  if (parts.size() != 3) fail("has " + std::to_string(parts.size()) + " elements, 3 are expected");
  return {parts[0].number(bounds), parts[1].number(bounds), parts[2].number(bounds)};
}

Vec3f JsonPlace::unit_vector() const {
  const Vec3f v = vector();
  const float length = glm::length(v);
  if (!(length > 1e-12f)) fail("is zero, a direction is expected");
  return v / length;
}

Vec3f JsonPlace::colour(Bounds bounds) const { return is_array() ? vector(bounds) : Vec3f(number(bounds)); }

float JsonPlace::number_or(std::string_view key, float otherwise, Bounds bounds) const {
  const auto p = find(key);
  return p ? p->number(bounds) : otherwise;
}

int JsonPlace::integer_or(std::string_view key, int otherwise, int least, int most) const {
  const auto p = find(key);
  return p ? p->integer(least, most) : otherwise;
}

bool JsonPlace::boolean_or(std::string_view key, bool otherwise) const {
  const auto p = find(key);
  return p ? p->boolean() : otherwise;
}

Vec3f JsonPlace::vector_or(std::string_view key, const Vec3f& otherwise) const {
  const auto p = find(key);
  return p ? p->vector() : otherwise;
}

Vec3f JsonPlace::colour_or(std::string_view key, const Vec3f& otherwise, Bounds bounds) const {
  const auto p = find(key);
  return p ? p->colour(bounds) : otherwise;
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "shared/material_name.h"

#include "shared/content_hash.h"

#include <algorithm>

namespace brdf::service {
namespace {

constexpr std::string_view materials = "materials/";
constexpr std::string_view versions = "/versions/";
constexpr std::size_t longest_id = 128;

}  // namespace

bool is_material_id(std::string_view text) noexcept {
  if (text.empty() || text.size() > longest_id || text.front() == '.') return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  });
}

std::optional<MaterialName> parse_material_name(std::string_view text) {
  if (!text.starts_with(materials)) return std::nullopt;
  text.remove_prefix(materials.size());
  MaterialName name;
  const std::size_t cut = text.find(versions);
  if (cut != std::string_view::npos) {
    name.version = text.substr(cut + versions.size());
    if (!is_version(name.version)) return std::nullopt;
    text = text.substr(0, cut);
  }
  if (!is_material_id(text)) return std::nullopt;
  name.id = text;
  return name;
}

std::string material_name(std::string_view id) { return std::string(materials).append(id); }

std::string version_name(std::string_view id, std::string_view version) {
  return material_name(id).append(versions).append(version);
}

}  // namespace brdf::service

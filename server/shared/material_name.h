// SPDX-License-Identifier: Apache-2.0
// Resource names: materials/{material} and materials/{material}/versions/{version}.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace brdf::service {

/// Letters, digits, '-', '_' and '.', not first a '.', at most 128: what is a file's name without `.brdfc` and can be no path.
bool is_material_id(std::string_view text) noexcept;

struct MaterialName {
  std::string id;
  std::string version;  ///< empty: the present one
};

/// Nothing for a text that is no resource name.
std::optional<MaterialName> parse_material_name(std::string_view text);

std::string material_name(std::string_view id);
std::string version_name(std::string_view id, std::string_view version);

}  // namespace brdf::service

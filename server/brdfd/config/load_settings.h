// SPDX-License-Identifier: Apache-2.0
// Flags before environment before TOML file before defaults.
#pragma once

#include "config/settings.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace brdf::service {

/// Value of a variable of the environment, or nothing.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// Texts of the flags that were given, by the setting's name.
using Flags = std::map<std::string, std::string, std::less<>>;

/// Settings of a TOML text; `name` begins sentences about it. Throws Error(invalid_argument) with the line.
void assign_toml(Settings& settings, std::string_view text, const std::string& name);

/// Throws Error: invalid_argument that names flag, variable, or file and line, io. An empty `file` is none.
Settings load_settings(const std::filesystem::path& file, const Environment& environment, const Flags& flags);

}  // namespace brdf::service

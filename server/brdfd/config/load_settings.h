// SPDX-License-Identifier: Apache-2.0
// Flags before environment before TOML file before defaults.
#pragma once

#include "config/settings.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace brdf::service {

/// Value of a variable of the environment, or nothing.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// Texts of the flags that were given, by the setting's name.
using Flags = std::map<std::string, std::string, std::less<>>;

/// Throws Error(invalid_argument) that names flag, variable, or file and line. An empty `file` is none.
Settings load_settings(const std::filesystem::path& file, const Environment& environment, const Flags& flags);

}  // namespace brdf::service

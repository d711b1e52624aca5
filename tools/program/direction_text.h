// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/direction.h>

#include <string>

namespace brdf::cli {

/// "X,Y,Z" as a unit vector. Throws CLI::ValidationError naming the option.
Vec3f parse_direction(const std::string& option, const std::string& text);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// What `info` says about a file, once as data and once for people.
#pragma once

#include "json_report.h"
#include "material_source.h"

#include <string>

namespace brdf::cli {

Json measured_info(const MaterialSource& source);
Json compressed_info(const MaterialSource& source);

std::string measured_text(const Json& row);
std::string compressed_text(const Json& row);

/// "lambert", "ggx", "retro_ggx".
const char* lobe_name(LobeKind kind) noexcept;

}  // namespace brdf::cli

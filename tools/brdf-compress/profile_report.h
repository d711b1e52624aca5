// SPDX-License-Identifier: Apache-2.0
// What a scene asked, for people and programs.
#pragma once

#include "json_report.h"

#include <brdf/profile.h>

#include <string>

namespace brdf::cli {

/// One row per material, the largest share first.
Json profile_rows(const Profile& profile);

/// Tables, and for each material the distribution over theta_h and theta_d as shades of grey.
std::string profile_text(const Json& rows);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Profiles that a user names.
#pragma once

#include <brdf/profile.h>

#include <string>

namespace brdf::cli {

/// Throws Failure(bad_input) with the path and the reason.
Profile read_profile(const std::string& path);

/// The slot that `wanted` names, or, where it is empty, the only one there is. Throws Failure(bad_input) with the slots.
std::string choose_slot(const Profile& profile, const std::string& path, const std::string& wanted);

}  // namespace brdf::cli

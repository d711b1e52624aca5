// SPDX-License-Identifier: Apache-2.0
#include "profile_input.h"

#include "base/file_io.h"
#include "exit_codes.h"
#include "verb_options.h"

#include <vector>

namespace brdf::cli {

Profile read_profile(const std::string& path) {
  std::vector<std::byte> bytes;
  try {
    bytes = base::read_file(path, ProfileLimits{}.max_file_bytes);
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, e.what());
  }
  try {
    return Profile::read(bytes);
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, path + ": " + e.what());
  }
}

std::string choose_slot(const Profile& profile, const std::string& path, const std::string& wanted) {
  if (!wanted.empty() && profile.materials.contains(wanted)) return wanted;
  if (wanted.empty() && profile.materials.size() == 1) return profile.materials.begin()->first;
  std::vector<std::string> names;
  for (const auto& entry : profile.materials) names.push_back(entry.first);
  if (names.empty()) throw Failure(ExitCode::bad_input, path + ": the profile holds no material");
  throw Failure(ExitCode::bad_input, path + (wanted.empty() ? ": several materials; --profile-material chooses of " : ": no material '" + wanted + "'; there is ") + listed(names));
}

}  // namespace brdf::cli

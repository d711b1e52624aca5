// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace brdf::cli {

/// The bytes of a file that a user named. Throws Failure(bad_input) with the path and the reason.
std::vector<std::byte> read_input(const std::filesystem::path& path);

}  // namespace brdf::cli

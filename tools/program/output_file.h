// SPDX-License-Identifier: Apache-2.0
// Files that a verb writes: whole or not at all, and nothing overwritten unasked.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace brdf::cli {

/// Says before the work what write_output would refuse after it: an existing file without -f, a folder that is missing
/// or read-only, the input itself.
void check_output(const std::filesystem::path& output, const std::filesystem::path& input, bool force);

/// Throws Failure(failed).
void write_output(const std::filesystem::path& output, std::span<const std::byte> bytes, bool force);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/file_io.h"
#include "exit_codes.h"

#include <brdf/limits.h>

#include <filesystem>
#include <vector>

namespace brdf::query {

/// The bytes of a file that a user named. Throws Failure(bad_input).
inline std::vector<std::byte> input_bytes(const std::filesystem::path& path) {
  try {
    return base::read_file(path, IngestLimits{}.max_file_bytes);
  } catch (const Error& e) {
    throw cli::Failure(cli::ExitCode::bad_input, e.what());
  }
}

}  // namespace brdf::query

// SPDX-License-Identifier: Apache-2.0
#include "input_file.h"

#include <brdf/limits.h>

#include "base/file_io.h"
#include "exit_codes.h"

namespace brdf::cli {

std::vector<std::byte> read_input(const std::filesystem::path& path) {
  try {
    return base::read_file(path, IngestLimits{}.max_file_bytes);
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, e.what());  // io has exit code 1 only when something was to be written
  }
}

}  // namespace brdf::cli

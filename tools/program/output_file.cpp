// SPDX-License-Identifier: Apache-2.0
#include "output_file.h"

#include "base/file_descriptor.h"
#include "base/file_io.h"
#include "exit_codes.h"
#include "interrupt.h"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

namespace brdf::cli {
namespace {

namespace fs = std::filesystem;

Failure exists_already(const fs::path& path) {
  return {ExitCode::failed, path.string() + ": exists already; -f replaces it"};
}

}  // namespace

void check_output(const fs::path& output, const fs::path& input, bool force) {
  std::error_code error;
  if (fs::equivalent(output, input, error) && !error) {
    throw Failure(ExitCode::usage, output.string() + ": the output is the input itself");
  }
  const fs::file_status status = fs::status(output, error);
  if (fs::is_directory(status)) throw Failure(ExitCode::failed, output.string() + ": is a directory, not a file");
  if (fs::is_regular_file(status) && !force) throw exists_already(output);
  if (fs::exists(status) && !fs::is_regular_file(status)) return;  // a device or pipe: the write itself will tell
  const fs::path folder = output.has_parent_path() ? output.parent_path() : fs::path(".");
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) throw base::io_error(output, "create", ENOTDIR);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) throw base::io_error(output, "create", errno);
}

void write_output(const fs::path& output, std::span<const std::byte> bytes, bool force) {
  const DeferInterrupt guard;
  base::write_file_atomically(output, bytes, force);
}

}  // namespace brdf::cli

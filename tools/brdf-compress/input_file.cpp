// SPDX-License-Identifier: Apache-2.0
#include "input_file.h"

#include <brdf/ingest.h>
#include <brdf/limits.h>

#include "base/file_io.h"
#include "exit_codes.h"

namespace brdf::cli {
namespace {

/// What cannot be read is refused by its first bytes, however large it is.
void check_head(std::span<const std::byte> head, std::uint64_t file_bytes, const std::string& name) {
  const FileFormat format = sniff(head, file_bytes);
  if (head.empty() || format == FileFormat::merl || format == FileFormat::rgl) return;
  if (format != FileFormat::brdfc) {
    (void)read_measurement(head, name);  // throws: it has the sentence for what this is
  } else if (const std::uint64_t most = DecodeLimits{}.max_file_bytes; file_bytes > most) {
    throw Error(ErrorCode::limit_exceeded, name + ": the .brdfc file has " + std::to_string(file_bytes) + " bytes, the limit is " + std::to_string(most));
  }
}

}  // namespace

std::vector<std::byte> read_input(const std::filesystem::path& path) {
  try {
    return base::read_file(path, IngestLimits{}.max_file_bytes, [&path](std::span<const std::byte> head, std::uint64_t file_bytes) {
      check_head(head, file_bytes, path.string());
    });
  } catch (const Error& e) {
    throw Failure(ExitCode::bad_input, e.what());  // io has exit code 1 only when something was to be written
  }
}

}  // namespace brdf::cli

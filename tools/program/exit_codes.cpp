// SPDX-License-Identifier: Apache-2.0
#include "exit_codes.h"

namespace brdf::cli {

// No default branch: the compiler then names a code that was added and not listed here. Error(io) of a file that was to
// be read is turned into bad_input where the file is opened (input_file.h).
ExitCode exit_code_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::invalid_argument: return ExitCode::usage;
    case ErrorCode::io: return ExitCode::failed;
    case ErrorCode::not_recognized:
    case ErrorCode::malformed:
    case ErrorCode::truncated:
    case ErrorCode::limit_exceeded:
    case ErrorCode::unsupported:
    case ErrorCode::checksum:
    case ErrorCode::no_data: return ExitCode::bad_input;
    case ErrorCode::target_not_met: return ExitCode::target_not_met;
    case ErrorCode::cancelled: return ExitCode::interrupted;
  }
  return ExitCode::failed;
}

}  // namespace brdf::cli

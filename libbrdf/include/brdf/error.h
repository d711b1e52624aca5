// SPDX-License-Identifier: Apache-2.0
/// @file error.h
/// The one exception type of libbrdf.
#pragma once

#include <stdexcept>
#include <string>

namespace brdf {

/// What went wrong, for programs. The sentence of the exception is for people.
enum class ErrorCode {
  invalid_argument,  ///< the caller asked for something that has no meaning
  io,                ///< the operating system refused to read or write
  not_recognized,    ///< the content is no format that libbrdf knows
  malformed,         ///< a known format whose fields contradict its definition
  truncated,         ///< shorter than its own header says
  limit_exceeded,    ///< larger than the limits of the caller allow
  unsupported,       ///< well formed, but needs what this version does not do
  checksum,          ///< the bytes are not those that were written
  no_data,           ///< nothing valid is left to work with
  target_not_met,    ///< a size or error target that cannot be reached
  cancelled,         ///< a progress callback asked to stop
};

/// Lower-case name of a code, e.g. "truncated".
const char* to_string(ErrorCode code) noexcept;

/// Thrown by every function of libbrdf that can fail. `what()` is one sentence that names the file or field,
/// the value found and the value allowed. Thread-safe like any exception.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace brdf

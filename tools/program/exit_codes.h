// SPDX-License-Identifier: Apache-2.0
// How the program ends, and the exception that says so.
#pragma once

#include <brdf/error.h>

#include <stdexcept>
#include <string>

namespace brdf::cli {

/// Promised to scripts; never renumbered.
enum class ExitCode : int {
  ok = 0,
  failed = 1,          ///< a check failed, or output could not be written
  usage = 2,           ///< the command line has no meaning
  bad_input = 3,       ///< a file or a row that cannot be read
  target_not_met = 4,  ///< nothing is written
  batch_failed = 5,    ///< some of several materials failed
  interrupted = 130,
};

ExitCode exit_code_of(ErrorCode code) noexcept;

/// Ends the verb with `code` and one sentence.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

}  // namespace brdf::cli

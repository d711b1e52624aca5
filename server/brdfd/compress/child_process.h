// SPDX-License-Identifier: Apache-2.0
// A program of its own, with limits that the kernel keeps.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace brdf::service {

struct ChildLimits {
  std::uint64_t memory_bytes = 0;      ///< address space; 0: no limit
  std::uint64_t file_bytes = 0;        ///< of a file that it writes; 0: no limit
  std::chrono::milliseconds time{0};   ///< until it is killed
};

struct ChildResult {
  enum class End { exited, signalled, timed_out, stopped };
  End end = End::exited;
  int code = 0;        ///< exit code or signal
  std::string errors;  ///< the first 4 KiB of its stderr
};

/// Runs `arguments` (the program's path first) with an empty environment but PATH and TMPDIR, stdin and stdout on
/// /dev/null, and nothing else open but a pipe as descriptor 3, whose lines go to `on_line`. `stop` is asked every 20 ms;
/// when it says so, or the time is over, the child and what it started are killed. Dies with this process. Blocks until
/// the child is gone. Throws Error(io) where it cannot be started.
ChildResult run_child(const std::vector<std::string>& arguments, const ChildLimits& limits, const std::function<void(const std::string&)>& on_line,
                      const std::function<bool()>& stop);

}  // namespace brdf::service

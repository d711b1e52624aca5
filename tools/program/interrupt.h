// SPDX-License-Identifier: Apache-2.0
// What Ctrl-C does.
#pragma once

namespace brdf::cli {

/// SIGINT and SIGTERM end the program at once with exit code 130 or 143: files appear whole at the very end, so nothing
/// partial can be left. SIGPIPE is ignored; writing to a closed pipe is then an error like any other.
void install_signal_handlers();

/// While one exists a signal waits: a file is being put in its place, or what there is must be written first. The last one
/// that goes ends the program if a signal has come.
class DeferInterrupt {
 public:
  DeferInterrupt() noexcept;
  ~DeferInterrupt();
  /// Whether a signal waits.
  bool arrived() const noexcept;
  DeferInterrupt(const DeferInterrupt&) = delete;
  DeferInterrupt& operator=(const DeferInterrupt&) = delete;
};

}  // namespace brdf::cli

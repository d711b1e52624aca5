// SPDX-License-Identifier: Apache-2.0
// A program that runs beside the load: the daemon, the echo service, a tool.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace brdf::load {

/// Descriptors that a started program may have open, as most systems have it. This process takes all that it may.
inline constexpr unsigned usual_descriptors = 1024;

/// Dies with its object, and with the thread that started it. Not thread-safe.
class Process {
 public:
  /// stderr goes to `log`. Throws std::runtime_error where it cannot be started.
  Process(const std::vector<std::string>& words, const std::filesystem::path& log);
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&&) = delete;

  /// Reads stdout until a line that contains `text`. Throws std::runtime_error where the program ends first or is silent.
  std::string wait_for_line(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(30));

  pid_t pid() const noexcept { return pid_; }
  bool runs();
  void signal(int number) const;
  /// Exit code, or minus the signal that ended it; -1000 where it did not end in time.
  int wait(std::chrono::seconds patience = std::chrono::seconds(60));
  void kill();

  std::uint64_t resident_bytes() const;       ///< now
  std::uint64_t peak_resident_bytes() const;  ///< since the start
  std::size_t descriptors() const;            ///< open now
  std::string descriptor_kinds() const;       ///< how many of what, to read

 private:
  std::uint64_t status_kilobytes(const std::string& field) const;

  pid_t pid_ = -1;
  int out_ = -1;
  int code_ = 0;
};

/// Runs a program to its end. Throws std::runtime_error where its exit code is not 0.
void run_program(const std::vector<std::string>& words, const std::filesystem::path& log);

}  // namespace brdf::load

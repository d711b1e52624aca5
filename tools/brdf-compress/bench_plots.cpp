// SPDX-License-Identifier: Apache-2.0
#include "bench_plots.h"

#include "exit_codes.h"
#include "output_file.h"
#include "plot_tradeoff_script.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

namespace brdf::cli {
namespace {

namespace fs = std::filesystem;

/// Runs a Python script and returns whether it ended well. Its output goes to stderr, or nowhere when `silent`.
bool run_script(const std::string& python, const char* script, std::vector<std::string> arguments, bool silent) {
  arguments.insert(arguments.begin(), {python, "-c", script});
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  if (silent) posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, python.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return false;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// The user's own Python first; Debian's package is found only by Debian's.
std::string python_with_matplotlib() {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (run_script(python, "import matplotlib", {}, true)) return python;
  throw Failure(ExitCode::failed, "plots need Python with matplotlib (Debian: python3-matplotlib), and none is found");
}

}  // namespace

BenchPlots::BenchPlots(fs::path folder, bool force) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_))
    throw Failure(ExitCode::failed, folder_.string() + ": is no folder and cannot be made one");
  check_output(folder_ / "tradeoff.json", {}, force);
  python_ = python_with_matplotlib();
}

void BenchPlots::write(const std::string& report) const {
  const fs::path rows = folder_ / "tradeoff.json";
  write_output(rows, std::as_bytes(std::span(report)), true);
  if (!run_script(python_, plot_tradeoff_script, {rows.string(), folder_.string()}, false))
    throw Failure(ExitCode::failed, folder_.string() + ": the plots could not be drawn");
}

}  // namespace brdf::cli

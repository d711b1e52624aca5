// SPDX-License-Identifier: Apache-2.0
#include "server/load/process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

namespace brdf::load {

Process::Process(const std::vector<std::string>& words, const std::filesystem::path& log) {
  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  for (std::string& w : copies) argv.push_back(w.data());
  argv.push_back(nullptr);
  std::array<int, 2> ends{};
  const int errors = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (errors < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(words.front() + ": no pipe or no log");
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {  // only calls that need no lock
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    if (limit.rlim_cur > usual_descriptors) limit.rlim_cur = usual_descriptors;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    ::dup2(ends[1], STDOUT_FILENO);
    ::dup2(errors, STDERR_FILENO);
    ::syscall(SYS_close_range, 3U, ~0U, 0U);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  ::close(errors);
  out_ = ends[0];
  if (pid_ < 0) throw std::runtime_error(words.front() + " cannot be started");
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), out_(std::exchange(other.out_, -1)), code_(other.code_) {}

Process::~Process() {
  kill();
  if (out_ >= 0) ::close(out_);
}

std::string Process::wait_for_line(const std::string& text, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  std::string line;
  while (std::chrono::steady_clock::now() < end) {
    pollfd ready{out_, POLLIN, 0};
    if (::poll(&ready, 1, 100) <= 0) continue;
    char c = 0;
    if (::read(out_, &c, 1) != 1) break;
    if (c != '\n') {
      line += c;
    } else if (line.find(text) != std::string::npos) {
      return line;
    } else {
      line.clear();
    }
  }
  throw std::runtime_error("a program did not say '" + text + "' but '" + line + "'");
}

bool Process::runs() {
  if (pid_ < 0) return false;
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return true;
  code_ = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  pid_ = -1;
  return false;
}

void Process::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

int Process::wait(std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (runs()) {
    if (std::chrono::steady_clock::now() > end) return -1000;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return code_;
}

void Process::kill() {
  signal(SIGKILL);
  wait();
}

std::uint64_t Process::status_kilobytes(const std::string& field) const {
  std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(field)) return std::stoull(line.substr(field.size())) * 1024;
  return 0;
}

std::uint64_t Process::resident_bytes() const { return status_kilobytes("VmRSS:"); }
std::uint64_t Process::peak_resident_bytes() const { return status_kilobytes("VmHWM:"); }

std::size_t Process::descriptors() const {
  std::error_code ignored;
  std::size_t count = 0;
  for (std::filesystem::directory_iterator at("/proc/" + std::to_string(pid_) + "/fd", ignored), end; at != end; at.increment(ignored)) ++count;
  return count;
}

std::string Process::descriptor_kinds() const {
  std::map<std::string, int> kinds;
  std::error_code ignored;
  for (std::filesystem::directory_iterator at("/proc/" + std::to_string(pid_) + "/fd", ignored), end; at != end; at.increment(ignored)) {
    const std::string target = std::filesystem::read_symlink(at->path(), ignored).string();
    ++kinds[target.starts_with("socket:") || target.starts_with("pipe:") ? target.substr(0, target.find(':')) : target];
  }
  std::string text;
  for (const auto& [kind, count] : kinds) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  return text;
}

void run_program(const std::vector<std::string>& words, const std::filesystem::path& log) {
  Process process(words, log);
  const int code = process.wait(std::chrono::seconds(600));
  if (code != 0) throw std::runtime_error(words.front() + " ended with " + std::to_string(code) + ", see its messages in " + log.string());
}

}  // namespace brdf::load

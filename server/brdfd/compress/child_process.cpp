// SPDX-License-Identifier: Apache-2.0
#include "compress/child_process.h"

#include "base/file_descriptor.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

namespace brdf::service {
namespace {

constexpr int progress_descriptor = 3;
constexpr int lost_status = 127 << 8;  // as of one that could not be started
constexpr std::size_t longest_line = 256, longest_errors = 4096;

struct Pipe {
  base::FileDescriptor read, write;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw base::io_error("a pipe", "make", errno);
  Pipe p;
  p.read = base::FileDescriptor(ends[0]);
  p.write = base::FileDescriptor(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return p;
}

void limit(int resource, std::uint64_t value) noexcept {
  const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Between fork and exec of a process with threads only calls that need no lock are allowed.
[[noreturn]] void become(char* const* argv, char* const* envp, const ChildLimits& limits, int null, int progress, int errors, pid_t parent) noexcept {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGPIPE, SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
  // Copies above the places that are taken next, so that none of them is overwritten.
  const int from[] = {::fcntl(null, F_DUPFD, 16), ::fcntl(errors, F_DUPFD, 16), ::fcntl(progress, F_DUPFD, 16)};
  ::dup2(from[0], STDIN_FILENO);
  ::dup2(from[0], STDOUT_FILENO);
  ::dup2(from[1], STDERR_FILENO);
  ::dup2(from[2], progress_descriptor);
  ::syscall(SYS_close_range, progress_descriptor + 1, ~0U, 0);
  if (limits.memory_bytes != 0) limit(RLIMIT_AS, limits.memory_bytes);
  if (limits.file_bytes != 0) limit(RLIMIT_FSIZE, limits.file_bytes);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, 64);
  ::setpriority(PRIO_PROCESS, 0, 10);  // renderers that wait for answers come first
  ::execve(argv[0], argv, envp);
  ::_exit(127);
}

/// Moves what is there from a pipe to `text`, and not for ever where somebody goes on writing; false at its end.
bool drain(int fd, std::string& text, std::size_t most) {
  std::array<char, 4096> buffer;
  for (int reads = 0; reads < 64; ++reads) {
    const ::ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno == EAGAIN;
    if (n == 0) return false;
    text.append(buffer.data(), std::min(static_cast<std::size_t>(n), most - std::min(most, text.size())));
  }
  return true;
}

void hand_lines(std::string& text, const std::function<void(const std::string&)>& on_line) {
  for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1)) on_line(text.substr(0, end));
  if (text.size() >= longest_line) text.clear();
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& t : texts) list.push_back(t.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> small_environment() {
  std::vector<std::string> list;
  for (const char* name : {"PATH", "TMPDIR", "LD_LIBRARY_PATH", "ASAN_OPTIONS", "TSAN_OPTIONS"})
    if (const char* value = std::getenv(name)) list.push_back(std::string(name) + "=" + value);
  return list;
}

/// A child that an exception would leave behind.
class Running {
 public:
  explicit Running(pid_t child) noexcept : child_(child) {}
  ~Running() {
    ::kill(-child_, SIGKILL);  // it where it still runs, and whatever it may have started
    if (!collected_) ::waitpid(child_, nullptr, 0);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  void collected() noexcept { collected_ = true; }

 private:
  pid_t child_;
  bool collected_ = false;
};

}  // namespace

ChildResult run_child(const std::vector<std::string>& arguments, const ChildLimits& limits, const std::function<void(const std::string&)>& on_line,
                      const std::function<bool()>& stop) {
  std::vector<std::string> words = arguments, environment = small_environment();
  const std::vector<char*> argv = pointers(words), envp = pointers(environment);
  const base::FileDescriptor null(::open("/dev/null", O_RDWR | O_CLOEXEC));
  if (!null) throw base::io_error("/dev/null", "open", errno);
  Pipe progress = make_pipe(), errors = make_pipe();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw base::io_error(arguments.front(), "start", errno);
  if (child == 0) become(argv.data(), envp.data(), limits, null.get(), progress.write.get(), errors.write.get(), parent);
  ::setpgid(child, child);  // both sides do it, whoever comes first
  Running running(child);
  progress.write = base::FileDescriptor();
  errors.write = base::FileDescriptor();

  ChildResult result;
  const auto end = std::chrono::steady_clock::now() + limits.time;
  std::string line;
  int status = 0;
  for (bool gone = false; !gone;) {
    std::array<pollfd, 2> ready{pollfd{progress.read.get(), POLLIN, 0}, pollfd{errors.read.get(), POLLIN, 0}};
    ::poll(ready.data(), ready.size(), 20);
    const pid_t collected = ::waitpid(child, &status, WNOHANG);
    gone = collected == child || (collected < 0 && errno != EINTR);
    if (gone) running.collected();
    if (gone && collected < 0) status = lost_status;  // where children are collected by themselves, nobody learns how they ended
    const bool more = drain(progress.read.get(), line, longest_line * 16);
    const bool more_errors = drain(errors.read.get(), result.errors, longest_errors);
    hand_lines(line, on_line);
    if (!gone && result.end == ChildResult::End::exited) {
      if (stop()) result.end = ChildResult::End::stopped;
      if (std::chrono::steady_clock::now() >= end) result.end = ChildResult::End::timed_out;
      if (result.end != ChildResult::End::exited) ::kill(-child, SIGKILL);
    }
    // Both ends closed, yet the child lives: poll would return at once.
    if (!gone && !more && !more_errors) ::usleep(5000);
  }
  if (result.end == ChildResult::End::exited) {
    if (WIFSIGNALED(status)) result.end = ChildResult::End::signalled;
    result.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  return result;
}

}  // namespace brdf::service

// SPDX-License-Identifier: Apache-2.0
// The program brdfd as a process of its own, as whoever operates it sees it: flags, environment, signals, exit codes.
#pragma once

#include "server/daemon_fixture.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

extern char** environ;

namespace brdf::test {

using Words = std::vector<std::string>;

/// For machines that do other things as well.
inline constexpr std::chrono::seconds patience{60};

inline bool until(const std::function<bool()>& holds, std::chrono::milliseconds most = patience) {
  const auto end = std::chrono::steady_clock::now() + most;
  while (!holds()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

inline testing::AssertionResult says(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos ? testing::AssertionSuccess() : testing::AssertionFailure() << "'" << word << "' is not in: " << text;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// One run of brdfd; output and messages go to files. Killed at the end of the scope where it still runs.
class Process {
 public:
  explicit Process(const Words& flags, const Words& variables = {}) {
    const char* program = std::getenv("BRDFD");
    if (program == nullptr) throw std::runtime_error("BRDFD does not name the program");
    Words words{program}, environment = variables;
    words.insert(words.end(), flags.begin(), flags.end());
    for (char** v = environ; *v != nullptr; ++v)
      if (!std::string_view(*v).starts_with("BRDFD_")) environment.emplace_back(*v);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder_ / "out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int error = ::posix_spawn(&id_, program, &actions, nullptr, pointers(words).data(), pointers(environment).data());
    ::posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error(std::string("cannot start ") + program);
  }
  ~Process() {
    if (code_) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const { ::kill(id_, number); }
  std::string output() const { return text_of(folder_ / "out"); }
  std::string log() const { return text_of(folder_ / "log"); }

  /// The exit code, minus the signal that ended it, or nothing where it still runs.
  std::optional<int> poll() {
    int status = 0;
    if (!code_ && ::waitpid(id_, &status, WNOHANG) == id_) code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return code_;
  }
  std::optional<int> wait() {
    until([this] { return poll().has_value(); });
    return code_;
  }

 private:
  static std::vector<char*> pointers(Words& words) {
    std::vector<char*> list;
    for (std::string& w : words) list.push_back(w.data());
    list.push_back(nullptr);
    return list;
  }

  TemporaryFolder folder_;
  pid_t id_ = -1;
  std::optional<int> code_;
};

struct Finished {
  int code;
  std::string output, log;
};

/// Runs it to its end.
inline Finished run_brdfd(const Words& flags, const Words& variables = {}) {
  Process process(flags, variables);
  const auto code = process.wait();
  if (!code) throw std::runtime_error("brdfd did not end: " + process.log());
  return {*code, process.output(), process.log()};
}

/// A repository in a folder of its own, and the daemon that serves it.
class RunningDaemon {
 public:
  RunningDaemon() {
    std::filesystem::create_directory(folder / "materials");
    put("gold", golden("rgb-lobes"));
  }

  void put(const std::string& id, const std::vector<std::byte>& bytes) const { put_file(folder / ("materials/" + id + ".brdfc").c_str(), bytes); }
  std::string socket() const { return "unix:" + (folder / "socket").string(); }
  std::string place(const char* name) const { return (folder / name).string(); }
  void put_secret(const char* name, const std::string& text) const {
    put_text(folder / name, text);
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }

  /// Waits for the line that says that it is ready. `more` comes behind flags that make a quiet daemon.
  void start(const Words& more, const Words& variables = {}) {
    Words flags{"--repository", place("materials"), "--poll-interval-seconds", "3600", "--drain-delay-seconds", "0", "--workers", "2"};
    flags.insert(flags.end(), more.begin(), more.end());
    process.emplace(flags, variables);
    const auto ready = [this] { return process->output().ends_with(")\n"); };
    if (!until([&] { return ready() || process->poll(); }) || !ready()) throw std::runtime_error("not ready: " + process->log());
    std::istringstream line(process->output());
    std::string word;
    addresses.clear();
    while (line >> word && word != "ready:") {
    }
    while (line >> word && word.front() != '(') addresses.push_back(word);
  }

  /// A value of the log: what follows `name="` behind the first `event`.
  std::string logged(const std::string& event, const std::string& name) const {
    const std::string log = process->log();
    const std::size_t line = log.find(event), at = line == std::string::npos ? line : log.find(name + "=\"", line);
    if (at == std::string::npos) throw std::runtime_error(event + " is not in the log: " + log);
    const std::size_t first = at + name.size() + 2;
    return log.substr(first, log.find('"', first) - first);
  }

  TemporaryFolder folder;
  Words addresses;
  std::optional<Process> process;
};

/// A channel whose connections are nobody else's: a fresh handshake, and no waiting after someone's failure.
inline std::shared_ptr<grpc::Channel> fresh_channel(const std::string& address, const std::shared_ptr<grpc::ChannelCredentials>& credentials = grpc::InsecureChannelCredentials()) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, credentials, arguments);
}

/// What a small call answers there, with a bearer token where one is given.
inline grpc::Status ask(const std::shared_ptr<grpc::Channel>& channel, const std::string& token = {}, const std::string& material = "materials/gold") {
  Context context;
  if (!token.empty()) context.AddMetadata("authorization", "Bearer " + token);
  v1::GetMaterialRequest request;
  request.set_name(material);
  v1::GetMaterialResponse response;
  return v1::BrdfService::NewStub(channel)->GetMaterial(&context, request, &response);
}

}  // namespace brdf::test

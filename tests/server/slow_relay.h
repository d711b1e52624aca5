// SPDX-License-Identifier: Apache-2.0
// A far server: a port whose connections reach a unix socket late.
#pragma once

#include "base/file_descriptor.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <list>
#include <stdexcept>
#include <string>
#include <thread>

namespace brdf::test {

/// Takes each connection at once and answers nothing for `delay`, then passes on bytes both ways.
class SlowRelay {
 public:
  SlowRelay(std::string path, std::chrono::milliseconds delay) : path_(std::move(path)), delay_(delay), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(name);
    auto* const address = reinterpret_cast<sockaddr*>(&name);
    if (::bind(listener_.get(), address, size) != 0 || ::listen(listener_.get(), 64) != 0 || ::getsockname(listener_.get(), address, &size) != 0) throw std::runtime_error("no port for the relay");
    port_ = ntohs(name.sin_port);
    accepting_ = std::thread([this] { accept(); });
  }
  ~SlowRelay() {
    ended_ = true;
    accepting_.join();
    for (std::thread& t : relaying_) t.join();
  }
  SlowRelay(const SlowRelay&) = delete;
  SlowRelay& operator=(const SlowRelay&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  static bool readable(int fd) {
    pollfd one{fd, POLLIN, 0};
    return ::poll(&one, 1, 20) == 1;
  }

  void accept() {
    while (!ended_) {
      if (!readable(listener_.get())) continue;
      base::FileDescriptor client(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
      if (client) relaying_.emplace_back([this, fd = std::move(client)]() mutable { relay(std::move(fd)); });
    }
  }

  void relay(base::FileDescriptor client) const {
    for (const auto start = std::chrono::steady_clock::now(); std::chrono::steady_clock::now() - start < delay_;) {
      if (ended_) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const base::FileDescriptor server(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    path_.copy(name.sun_path, sizeof(name.sun_path) - 1);
    if (::connect(server.get(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0) return;
    const std::array<std::pair<int, int>, 2> ways{{{client.get(), server.get()}, {server.get(), client.get()}}};
    while (!ended_) {
      for (const auto& [from, to] : ways)
        if (readable(from) && !pass_on(from, to)) return;
    }
  }

  static bool pass_on(int from, int to) {
    std::array<char, 65536> bytes;
    const ::ssize_t got = ::recv(from, bytes.data(), bytes.size(), 0);
    for (::ssize_t sent = 0, n = 0; sent < got; sent += n) {
      n = ::send(to, bytes.data() + sent, static_cast<std::size_t>(got - sent), MSG_NOSIGNAL);
      if (n <= 0) return false;
    }
    return got > 0;
  }

  std::string path_;
  std::chrono::milliseconds delay_;
  base::FileDescriptor listener_;
  std::uint16_t port_ = 0;
  std::atomic<bool> ended_{false};
  std::list<std::thread> relaying_;
  std::thread accepting_;
};

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// A connection whose bytes are written by hand.
#pragma once

#include "base/file_descriptor.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace brdf::load {

/// Neither retries nor reads what it is not told to. Not thread-safe.
class RawSocket {
 public:
  /// Connects to "unix:PATH" or to the port of an address on the loopback; not open() where it cannot.
  explicit RawSocket(const std::string& address) {
    if (address.starts_with("unix:")) {
      sockaddr_un name{};
      name.sun_family = AF_UNIX;
      const std::string path = address.substr(5);
      std::memcpy(name.sun_path, path.data(), std::min(path.size(), sizeof(name.sun_path) - 1));
      connect(name);
    } else {
      sockaddr_in name{};
      name.sin_family = AF_INET;
      name.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
      name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      connect(name);
    }
  }

  bool open() const noexcept { return static_cast<bool>(fd_); }
  /// False where the other side is gone, or does not take any of it for so long.
  bool send(std::string_view bytes, std::chrono::milliseconds patience = std::chrono::seconds(1)) {
    while (!bytes.empty()) {
      pollfd ready{fd_.get(), POLLOUT, 0};
      if (::poll(&ready, 1, static_cast<int>(patience.count())) != 1) return false;
      const ssize_t n = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  /// Throws away what came; false once the other side has closed.
  bool drain() {
    std::array<char, 65536> unread;
    for (;;) {
      const ssize_t n = ::recv(fd_.get(), unread.data(), unread.size(), MSG_DONTWAIT);
      if (n == 0) return false;
      if (n < 0) return errno == EAGAIN;
    }
  }

 private:
  template <class Name>
  void connect(const Name& name) {
    fd_ = base::FileDescriptor(::socket(reinterpret_cast<const sockaddr*>(&name)->sa_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (fd_ && ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0) fd_ = base::FileDescriptor();
  }

  base::FileDescriptor fd_;
};

}  // namespace brdf::load

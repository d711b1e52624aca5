// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace brdf::service {

/// unix:PATH, or HOST:PORT with a host in brackets where it holds colons.
struct ListenAddress {
  std::string path;  ///< of a unix socket
  std::string host;
  std::uint16_t port = 0;

  bool is_unix() const noexcept { return !path.empty(); }
  /// Only this machine reaches it: a unix socket, 127.0.0.0/8, ::1 or localhost.
  bool stays_here() const noexcept;
  /// As gRPC takes it.
  std::string text() const;
};

/// Throws Error(invalid_argument).
ListenAddress parse_listen_address(std::string_view text);

}  // namespace brdf::service

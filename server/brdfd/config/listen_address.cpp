// SPDX-License-Identifier: Apache-2.0
#include "config/listen_address.h"

#include <brdf/error.h>

#include <arpa/inet.h>
#include <sys/un.h>

#include <charconv>

namespace brdf::service {

bool ListenAddress::stays_here() const noexcept {
  if (is_unix() || host == "localhost") return true;
  in_addr four{};
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1) return (ntohl(four.s_addr) >> 24) == 127;
  in6_addr six{};
  return ::inet_pton(AF_INET6, host.c_str(), &six) == 1 && IN6_IS_ADDR_LOOPBACK(&six);
}

std::string ListenAddress::text() const {
  if (is_unix()) return "unix:" + path;
  const bool colons = host.find(':') != std::string::npos;
  return (colons ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

ListenAddress parse_listen_address(std::string_view text) {
  const auto refuse = [text](const std::string& why) -> Error {
    return {ErrorCode::invalid_argument, "'" + std::string(text) + "' is no address: " + why};
  };
  ListenAddress address;
  constexpr std::string_view unix_prefix = "unix:";
  if (text.starts_with(unix_prefix)) {
    address.path = text.substr(unix_prefix.size());
    constexpr std::size_t longest = sizeof(sockaddr_un{}.sun_path) - 1;
    if (address.path.empty()) throw refuse("the path is empty");
    if (address.path.size() > longest) throw refuse("the path of a socket has at most " + std::to_string(longest) + " characters");
    return address;
  }
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0) throw refuse("wanted is unix:PATH or HOST:PORT");
  std::string_view host = text.substr(0, colon);
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    throw refuse("a host with colons stands in brackets");
  }
  address.host = host;
  const std::string_view port = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (error != std::errc{} || end != port.data() + port.size()) throw refuse("the port must be 0 to 65535");
  return address;
}

}  // namespace brdf::service

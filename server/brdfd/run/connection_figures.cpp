// SPDX-License-Identifier: Apache-2.0
#include "run/connection_figures.h"

#include <grpc/grpc.h>
#include <grpc/support/alloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

namespace brdf::service {
namespace {

using Json = nlohmann::json;

/// Takes the text over. Null for none, or one that is no JSON.
Json parsed(char* text) {
  Json object = text == nullptr ? Json() : Json::parse(text, nullptr, false);
  ::gpr_free(text);
  return object;
}

/// Null where there is none.
const Json& member(const Json& of, const char* name) {
  static const Json none;
  const auto at = of.is_object() ? of.find(name) : of.end();
  return at == of.end() ? none : *at;
}

std::string text(const Json& of, const char* name) {
  const Json& value = member(of, name);
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// JSON has 64-bit integers as strings, and zero as nothing at all.
std::uint64_t integer(const Json& of, const char* name) { return std::strtoull(text(of, name).c_str(), nullptr, 10); }

std::intptr_t identity(const Json& of, const char* name) { return static_cast<std::intptr_t>(integer(of, name)); }

ConnectionFigures of_socket(std::intptr_t id, const Json& socket) {
  ConnectionFigures f;
  f.id = id;
  const Json& data = member(socket, "data");
  const std::uint64_t ended = integer(data, "streamsSucceeded") + integer(data, "streamsFailed"), begun = integer(data, "streamsStarted");
  f.streams = begun - std::min(begun, ended);
  const Json& peer = member(member(socket, "remote"), "tcpip_address");
  f.address = text(peer, "ip_address");
  const Json& port = member(peer, "port");
  f.port = port.is_number_unsigned() ? port.get<std::uint16_t>() : std::uint16_t{0};
  return f;
}

}  // namespace

std::vector<ConnectionFigures> connection_figures() {
  std::vector<ConnectionFigures> all;
  const Json servers = parsed(::grpc_channelz_get_servers(0));
  for (const Json& server : member(servers, "server")) {
    const std::intptr_t id = identity(member(server, "ref"), "serverId");
    std::intptr_t next = 0;
    for (bool end = false; !end;) {
      const Json page = parsed(::grpc_channelz_get_server_sockets(id, next, 500));
      const Json& sockets = member(page, "socketRef");
      end = member(page, "end") == true || sockets.empty();
      for (const Json& reference : sockets) {
        const std::intptr_t socket = identity(reference, "socketId");
        next = socket + 1;
        all.push_back(of_socket(socket, member(parsed(::grpc_channelz_get_socket(socket)), "socket")));
      }
    }
  }
  return all;
}

}  // namespace brdf::service

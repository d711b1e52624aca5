// SPDX-License-Identifier: Apache-2.0
#include "run/server_options.h"

#include "run/credentials.h"

#include <brdf/error.h>

#include <grpcpp/impl/server_builder_option.h>
#include <grpcpp/resource_quota.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <deque>

#include "base/file_descriptor.h"

namespace brdf::service {
namespace {

int milliseconds(double seconds) { return static_cast<int>(seconds * 1000); }

/// gRPC takes a socket's path from whoever listens there, without asking.
void require_free(const ListenAddress& address) {
  if (!address.is_unix()) return;
  const base::FileDescriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::memcpy(name.sun_path, address.path.data(), address.path.size());  // its length was checked
  if (probe && ::connect(probe.get(), reinterpret_cast<const sockaddr*>(&name), sizeof(name)) == 0) {
    throw Error(ErrorCode::io, address.text() + ": another process listens there");
  }
}

/// The library of reflection registers itself with every server by being linked; this takes it out again.
class WithoutReflection : public grpc::ServerBuilderOption {
 public:
  void UpdateArguments(grpc::ChannelArguments*) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [](const auto& plugin) { return plugin->name() == "proto_server_reflection"; });
  }
};

}  // namespace

void set_server_options(grpc::ServerBuilder& builder, const Settings& s) {
  grpc::ResourceQuota quota("brdfd");
  quota.Resize(static_cast<std::size_t>(s.connection_memory_bytes));
  builder.SetResourceQuota(quota);
  if (!s.reflection) builder.SetOption(std::make_unique<WithoutReflection>());
  builder.SetMaxReceiveMessageSize(static_cast<int>(s.max_message_bytes));
  builder.SetMaxSendMessageSize(static_cast<int>(s.max_message_bytes) + 65536);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, milliseconds(s.handshake_timeout_seconds));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(s.keepalive_seconds));
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, milliseconds(s.keepalive_seconds));
  // A connection without calls is asked, too: a half-open one is found out.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 5000);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, milliseconds(s.max_idle_seconds));
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, static_cast<int>(s.max_streams));
  builder.AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, 16384);
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 1);
}

std::unique_ptr<grpc::Server> start_listening(grpc::ServerBuilder& builder, const TextList& listen, const Settings& settings, std::vector<std::string>& bound) {
  std::deque<int> ports;
  std::deque<ListenAddress> addresses;
  for (const std::string& text : listen) {
    const ListenAddress& address = addresses.emplace_back(parse_listen_address(text));
    require_free(address);
    builder.AddListeningPort(address.text(), listener_credentials(address, settings), &ports.emplace_back(0));
  }
  std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  for (std::size_t i = 0; i < addresses.size(); ++i) {
    ListenAddress& address = addresses[i];
    if (!server || ports[i] == 0) throw Error(ErrorCode::io, address.text() + ": cannot listen there");
    if (!address.is_unix()) address.port = static_cast<std::uint16_t>(ports[i]);
    bound.push_back(address.text());
  }
  return server;
}

}  // namespace brdf::service

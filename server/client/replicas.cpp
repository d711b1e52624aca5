// SPDX-License-Identifier: Apache-2.0
#include "client/replicas.h"

#include "base/file_io.h"

#include <brdf/error.h>

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <arpa/inet.h>

#include <algorithm>
#include <numeric>

namespace brdf::client {
namespace {

constexpr std::string_view unix_prefix = "unix:";

std::string_view host_of(std::string_view server) {
  const std::string_view host = server.substr(0, server.rfind(':'));
  return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

const char* scheme_of(const std::string& server) {
  if (server.starts_with(unix_prefix)) return "unix";
  const std::string host(host_of(server));
  in6_addr address{};
  if (::inet_pton(AF_INET, host.c_str(), &address) == 1) return "ipv4";
  if (::inet_pton(AF_INET6, host.c_str(), &address) == 1) return "ipv6";
  return "dns";
}

std::string read_text(const std::string& file) {
  if (file.empty()) return {};
  const auto bytes = base::read_file(file, std::uint64_t{1} << 20);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::shared_ptr<grpc::ChannelCredentials> credentials_of(const ClientOptions& o) {
  if (o.ca_file.empty()) return grpc::InsecureChannelCredentials();
  return grpc::SslCredentials({read_text(o.ca_file), read_text(o.key_file), read_text(o.certificate_file)});
}

/// FNV-1a (Fowler, Noll and Vo), finished by SplitMix64's mixer: the same weights in every process.
std::uint64_t weight(std::string_view server, std::string_view material) noexcept {
  std::uint64_t h = 0xcbf29ce484222325U;
  for (const std::string_view text : {server, std::string_view("\n"), material})
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
  return h ^ (h >> 31);
}

}  // namespace

std::string target_of(const std::vector<std::string>& servers) {
  if (servers.empty()) throw Error(ErrorCode::invalid_argument, "no server is named, wanted is unix:PATH or HOST:PORT");
  const std::string scheme = scheme_of(servers.front());
  std::string list;
  for (const std::string& server : servers) {
    const bool is_unix = server.starts_with(unix_prefix);
    if (server.empty() || server.find(',') != std::string::npos || (!is_unix && server.rfind(':') == std::string::npos)) {
      throw Error(ErrorCode::invalid_argument, "'" + server + "' is no server, wanted is unix:PATH or HOST:PORT");
    }
    if (scheme_of(server) != scheme || (scheme == "dns" && servers.size() > 1)) {
      throw Error(ErrorCode::invalid_argument, "several servers must be all sockets or all numeric addresses of one kind; '" + server + "' is none such");
    }
    list += (list.empty() ? "" : ",") + (is_unix ? server.substr(unix_prefix.size()) : server);
  }
  return scheme + ":" + list;
}

std::string service_config() {
  return R"({
    "loadBalancingConfig": [{"round_robin": {}}],
    "healthCheckConfig": {"serviceName": "brdf.v1.BrdfService"},
    "methodConfig": [{
      "name": [
        {"service": "brdf.v1.BrdfService", "method": "ListMaterials"}, {"service": "brdf.v1.BrdfService", "method": "GetMaterial"},
        {"service": "brdf.v1.BrdfService", "method": "DownloadMaterial"}, {"service": "brdf.v1.BrdfService", "method": "Evaluate"},
        {"service": "brdf.v1.BrdfService", "method": "Albedo"}, {"service": "brdf.v1.BrdfService", "method": "FindSimilar"}
      ],
      "retryPolicy": {
        "maxAttempts": 4, "initialBackoff": "0.02s", "maxBackoff": "0.5s", "backoffMultiplier": 3,
        "retryableStatusCodes": ["UNAVAILABLE", "RESOURCE_EXHAUSTED"]
      }
    }]
  })";
}

std::vector<std::size_t> servers_for(const std::vector<std::string>& servers, std::string_view material) {
  std::vector<std::size_t> order(servers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const std::uint64_t wa = weight(servers[a], material), wb = weight(servers[b], material);
    return wa != wb ? wa > wb : a < b;
  });
  return order;
}

Replicas::Replicas(const ClientOptions& options) : servers_(options.by_material ? options.servers : std::vector<std::string>{}) {
  const auto credentials = credentials_of(options);
  grpc::ChannelArguments arguments;
  arguments.SetServiceConfigJSON(service_config());
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 20'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 10'000);
  // What gRPC calls the least pause between attempts is the time that each of them has: TCP, TLS and the first frame of a far server.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5'000);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 2'000);
  if (servers_.empty()) {
    channels_.push_back(grpc::CreateCustomChannel(target_of(options.servers), credentials, arguments));
  } else {
    for (const std::string& server : servers_) channels_.push_back(grpc::CreateCustomChannel(target_of({server}), credentials, arguments));
  }
}

std::vector<std::shared_ptr<grpc::Channel>> Replicas::channels_for(std::string_view material) const {
  if (servers_.empty()) return channels_;
  std::vector<std::shared_ptr<grpc::Channel>> ordered;
  for (const std::size_t i : servers_for(servers_, material)) ordered.push_back(channels_[i]);
  return ordered;
}

}  // namespace brdf::client

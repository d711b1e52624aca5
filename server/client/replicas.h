// SPDX-License-Identifier: Apache-2.0
// Channels to the servers, and which one a material belongs to.
#pragma once

#include <brdf/client/client.h>

#include <grpcpp/channel.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace brdf::client {

/// What gRPC calls a target that stands for all of them. Throws Error(invalid_argument).
std::string target_of(const std::vector<std::string>& servers);

/// round_robin over replicas that say SERVING; calls that are safe to repeat are, on UNAVAILABLE and RESOURCE_EXHAUSTED.
std::string service_config();

/// Rendezvous hashing (Thaler and Ravishankar 1998, "Using name-based mappings to increase hit rates", section 3): the
/// servers by falling weight for a material. Taking one away moves only its own materials.
std::vector<std::size_t> servers_for(const std::vector<std::string>& servers, std::string_view material);

class Replicas {
 public:
  explicit Replicas(const ClientOptions& options);

  /// Channels for a material, the first to be asked first; one channel for all servers in round robin.
  std::vector<std::shared_ptr<grpc::Channel>> channels_for(std::string_view material) const;
  std::shared_ptr<grpc::Channel> any() const { return channels_.front(); }

 private:
  std::vector<std::string> servers_;
  std::vector<std::shared_ptr<grpc::Channel>> channels_;
};

}  // namespace brdf::client

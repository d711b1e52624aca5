// SPDX-License-Identifier: Apache-2.0
// grpc.health.v1 from its own proto file: gRPC's built-in service cannot be described by reflection.
#pragma once

#include "grpc/health/v1/health.grpc.pb.h"

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace brdf::service {

/// Thread-safe.
class HealthService : public grpc::health::v1::Health::CallbackService {
 public:
  /// Names that are answered, beside the empty one.
  explicit HealthService(std::vector<std::string> services) : services_(std::move(services)) {}

  void set_serving(bool serving);
  /// Watch calls that are open.
  std::size_t watching() const;
  /// Ends the Watch calls, so that they do not hold up the end of the server.
  void end();

  grpc::ServerUnaryReactor* Check(grpc::CallbackServerContext* context, const grpc::health::v1::HealthCheckRequest* request,
                                  grpc::health::v1::HealthCheckResponse* response) override;
  grpc::ServerWriteReactor<grpc::health::v1::HealthCheckResponse>* Watch(grpc::CallbackServerContext* context,
                                                                         const grpc::health::v1::HealthCheckRequest* request) override;

 private:
  class Watcher;
  static constexpr std::size_t most_watchers = 10'000;

  bool knows(const std::string& service) const;
  void poke_all();

  const std::vector<std::string> services_;
  mutable std::mutex mutex_;
  bool serving_ = false, ended_ = false;
  std::set<std::shared_ptr<Watcher>> watchers_;
};

}  // namespace brdf::service

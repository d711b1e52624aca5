// SPDX-License-Identifier: Apache-2.0
// When a call is worth another attempt: what gRPC does by itself for calls of one answer (client/replicas.cpp), for those whose retries
// must know what was answered.
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/support/status.h>

#include <chrono>

namespace brdf::client {

class Backoff {
 public:
  explicit Backoff(std::chrono::milliseconds deadline) : until_(std::chrono::system_clock::now() + deadline) {}

  /// What is left of the deadline.
  std::chrono::milliseconds left() const;
  /// Something was answered: attempts count from here.
  void progress() noexcept { failures_ = 0; }
  /// Waits before the next attempt; false where there is to be none: another status, four attempts without an answer, the deadline.
  bool again(const grpc::Status& status, const grpc::ClientContext& context);

 private:
  std::chrono::system_clock::time_point until_;
  int failures_ = 0;
};

}  // namespace brdf::client

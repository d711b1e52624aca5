// SPDX-License-Identifier: Apache-2.0
// Calls that are sent at their own pace, whether or not the answers keep up: what a crowd of clients does.
#pragma once

#include "server/load/latency.h"
#include "server/load/setup.h"

#include <atomic>
#include <map>

namespace brdf::load {

/// Sends Albedo calls, which are a few bytes long and many queries to work on. Thread-safe.
class OpenLoop {
 public:
  OpenLoop(const std::string& address, const v1::AlbedoRequest& request, int connections);
  /// Waits for the calls under way.
  ~OpenLoop();

  /// Sends one; nothing waits for it.
  void send();
  /// Sends at a rate for a time, then waits for all answers.
  void send(double calls_per_second, std::chrono::duration<double> time);
  void wait_for_all() const;
  std::size_t under_way() const noexcept { return under_way_; }

  struct Counts {
    std::vector<double> accepted, refused;  ///< seconds of each
    std::uint64_t without_pushback = 0;     ///< refusals that did not say when to come back
    std::map<int, std::uint64_t> others;    ///< by status
    std::uint64_t not_sent = 0;             ///< this process had too many under way
  };
  Counts take();

 private:
  struct OneCall;
  void done(OneCall& call, const grpc::Status& status);

  const v1::AlbedoRequest request_;
  std::vector<std::unique_ptr<v1::BrdfService::Stub>> stubs_;
  std::atomic<std::size_t> next_{0}, under_way_{0};
  std::atomic<std::uint64_t> not_sent_{0}, without_pushback_{0};
  Latencies accepted_, refused_;
  std::mutex mutex_;
  std::map<int, std::uint64_t> others_;
};

}  // namespace brdf::load

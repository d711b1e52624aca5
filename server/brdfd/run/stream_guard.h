// SPDX-License-Identifier: Apache-2.0
// Cuts connections that open and reset streams faster than they can be taken down (CVE-2023-44487). gRPC 1.51 counts a reset stream as gone
// at once, so that its bound on streams never holds, but keeps 20 kB of each until the connection falls silent.
#pragma once

#include "rpc/metrics.h"

#include <grpcpp/server_builder.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

namespace brdf::service {

class StreamGuard {
 public:
  /// Watches what is served by whoever was built with `watch`. A connection may have `max_streams` streams; one that has eight times as
  /// many is cut.
  StreamGuard(Metrics& metrics, std::uint64_t max_streams);
  ~StreamGuard();
  StreamGuard(const StreamGuard&) = delete;
  StreamGuard& operator=(const StreamGuard&) = delete;

  /// Before BuildAndStart.
  void watch(grpc::ServerBuilder& builder) const;

 private:
  void work();
  void look();

  Metrics& metrics_;
  const std::uint64_t most_streams_;
  const std::shared_ptr<std::atomic<std::int64_t>> calls_;
  std::map<std::int64_t, std::chrono::steady_clock::time_point> cut_;  ///< by id, while gRPC takes them down
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace brdf::service

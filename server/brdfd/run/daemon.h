// SPDX-License-Identifier: Apache-2.0
// Servers, repository and threads together.
#pragma once

#include "rpc/brdf_service.h"
#include "rpc/admin_service.h"
#include "rpc/health_service.h"
#include "rpc/serving.h"
#include "run/stream_guard.h"

#include <grpcpp/server.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace prometheus {
class Exposer;
}

namespace brdf::service {

/// Serves from its construction to its destruction.
class Daemon {
 public:
  /// Reads the repository (unless it is explicit), then listens. Throws Error: invalid_argument, io.
  explicit Daemon(const Settings& settings);
  ~Daemon();
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  /// Where it listens; port 0 is answered with the port that the system chose.
  const std::vector<std::string>& addresses() const noexcept { return addresses_; }
  std::size_t materials() const { return serving_.repository.catalogue()->materials().size(); }
  Serving& serving() noexcept { return serving_; }

  /// Looks at the repository now, and reads the tokens again; what goes wrong is logged.
  void reload() noexcept;

  /// Says NOT_SERVING, goes on for `drain_delay_seconds`, then takes no new calls and waits for those in flight. Returns
  /// early once `hurry` is set.
  void drain(const std::atomic<bool>& hurry);

 private:
  void read_tokens();
  void listen();
  void listen_for_admin();
  void expose_metrics();
  void poll_regularly();
  void stop();

  Serving serving_;
  Watchers watchers_;
  EvaluateStreams streams_;
  BrdfServiceImpl brdf_;
  AdminServiceImpl admin_;
  HealthService health_, admin_health_;
  StreamGuard stream_guard_;
  std::unique_ptr<grpc::Server> server_, admin_server_;
  std::unique_ptr<prometheus::Exposer> exposer_;
  std::vector<std::string> addresses_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false, drained_ = false;
  std::thread poller_;
};

}  // namespace brdf::service

// SPDX-License-Identifier: Apache-2.0
// Who wants to know of every change.
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

#include <memory>
#include <mutex>
#include <set>

namespace brdf::service {

/// A watcher holds the catalogue that it has told of and is poked; what it says next is the difference to the present one.
/// A slow client so costs no queue, and sees the last state of each material. Thread-safe.
class Watchers {
 public:
  class Watcher;

  /// A reactor of its own life.
  grpc::ServerWriteReactor<v1::WatchMaterialsResponse>* start(Serving& serving, grpc::CallbackServerContext* context, const v1::WatchMaterialsRequest* request);

  /// After each swap, and once `serving.ending` is set.
  void poke();

 private:
  bool add(const std::shared_ptr<Watcher>& watcher, std::uint64_t most);
  void remove(const std::shared_ptr<Watcher>& watcher);

  std::mutex mutex_;
  std::set<std::shared_ptr<Watcher>> watchers_;
};

}  // namespace brdf::service

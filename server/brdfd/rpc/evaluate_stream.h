// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "brdf/v1/brdf_service.pb.h"
#include "rpc/call.h"

#include <grpcpp/support/server_callback.h>

#include <memory>
#include <mutex>
#include <set>

namespace brdf::service {

/// Streams that are open, so that the end of the server can end them: one that nobody writes to would hold it up. Thread-safe.
class EvaluateStreams {
 public:
  class Stream;

  /// A reactor of its own life: answers up to four batches of the stream at once, in the order of the requests. A client that
  /// sends faster than it reads is not read on.
  grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* start(Serving& serving, grpc::CallbackServerContext* context);

  /// Once `serving.ending` is set: each stream answers what it has read and ends with UNAVAILABLE.
  void end();

 private:
  void add(const std::shared_ptr<Stream>& stream);
  void remove(const std::shared_ptr<Stream>& stream);

  std::mutex mutex_;
  std::set<std::shared_ptr<Stream>> streams_;
};

}  // namespace brdf::service

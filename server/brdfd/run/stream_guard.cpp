// SPDX-License-Identifier: Apache-2.0
#include "run/stream_guard.h"

#include "config/log.h"
#include "run/connection_figures.h"
#include "run/cut_connection.h"

#include <grpcpp/generic/async_generic_service.h>

namespace brdf::service {
namespace {

using namespace std::chrono_literals;

/// Counts calls from their first frame until everything of them is gone, which no reactor could: most of a flood ends before there is one.
class CountingAllocator : public grpc::ContextAllocator {
 public:
  explicit CountingAllocator(std::shared_ptr<std::atomic<std::int64_t>> calls) : calls_(std::move(calls)) {}
  grpc::CallbackServerContext* NewCallbackServerContext() override {
    ++*calls_;
    return new grpc::CallbackServerContext;
  }
  /// Calls of methods that nobody serves.
  grpc::GenericCallbackServerContext* NewGenericCallbackServerContext() override {
    ++*calls_;
    return new grpc::GenericCallbackServerContext;
  }
  /// Of either kind: gRPC gives back a generic one as what it derives from.
  void Release(grpc::CallbackServerContext* context) override {
    delete context;
    --*calls_;
  }
  void Release(grpc::GenericCallbackServerContext* context) override { Release(static_cast<grpc::CallbackServerContext*>(context)); }

 private:
  const std::shared_ptr<std::atomic<std::int64_t>> calls_;
};

}  // namespace

StreamGuard::StreamGuard(Metrics& metrics, std::uint64_t max_streams)
    : metrics_(metrics), most_streams_(8 * max_streams), calls_(std::make_shared<std::atomic<std::int64_t>>(0)), thread_([this] { work(); }) {}

StreamGuard::~StreamGuard() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void StreamGuard::watch(grpc::ServerBuilder& builder) const {
  builder.SetContextAllocator(std::make_unique<CountingAllocator>(calls_));
  builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 1);
}

void StreamGuard::work() {
  std::unique_lock lock(mutex_);
  std::chrono::steady_clock::duration pause = 50ms;
  while (!wake_.wait_for(lock, pause, [this] { return ending_; })) {
    pause = 50ms;
    // Fewer calls than one connection must have to be cut: nothing to look for.
    if (*calls_ <= static_cast<std::int64_t>(most_streams_)) continue;
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    try {
      look();
    } catch (const std::exception& e) {  // a flood may have taken the memory for it; the next look comes
      log_event(Severity::error, "connections.unseen", {{"reason", e.what()}});
    }
    // A look at thousands of honest connections takes a while; it shall not take more than a tenth of a processor.
    pause = std::max<std::chrono::steady_clock::duration>(pause, 10 * (std::chrono::steady_clock::now() - start));
    lock.lock();
  }
}

void StreamGuard::look() {
  const auto now = std::chrono::steady_clock::now();
  std::erase_if(cut_, [&](const auto& c) { return now - c.second > 1min; });
  for (const ConnectionFigures& f : connection_figures()) {
    if (f.streams <= most_streams_) continue;
    // Taking thousands of streams down takes a while. Who is still there after that was not the one that went.
    const auto before = cut_.find(f.id);
    if (before != cut_.end() && now - before->second < 500ms) continue;
    const std::string peer = cut_connection(f);
    if (peer.empty()) continue;
    cut_[f.id] = now;
    metrics_.count_cut();
    log_event(Severity::warning, "connection.cut", {{"peer", peer}, {"streams", std::to_string(f.streams)}});
  }
}

}  // namespace brdf::service

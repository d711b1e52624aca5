// SPDX-License-Identifier: Apache-2.0
#include "client/backoff.h"
#include "client/client_state.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <span>
#include <thread>

namespace brdf::client {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 18;
constexpr std::size_t most_unanswered = 8;  // the server works on four at once

using Next = std::function<bool(v1::EvaluateRequest&)>;
using Answer = std::function<void(std::uint64_t, const v1::EvaluateResponse&)>;

/// Batches that are asked for and not yet answered. They outlive a connection: another one begins with them.
class Batches {
 public:
  explicit Batches(const Next& next) : next_(next) {}

  /// What is to be sent now; null at the end, or when the connection is over. Called by one thread.
  std::shared_ptr<const v1::EvaluateStreamRequest> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return over_ || sent_ < unanswered_.size() || exhausted_ || unanswered_.size() < most_unanswered; });
    if (over_ || (exhausted_ && sent_ == unanswered_.size())) return nullptr;
    if (sent_ == unanswered_.size()) {
      lock.unlock();
      const auto request = std::make_shared<v1::EvaluateStreamRequest>();
      const bool more = next_(*request->mutable_request());
      lock.lock();
      exhausted_ = !more;
      if (!more) return nullptr;
      request->set_id(count_++);
      unanswered_.push_back(request);
    }
    return over_ ? nullptr : unanswered_[sent_++];
  }

  /// Throws CallError where the answer is none of what was asked.
  void answered(std::uint64_t id) {
    const std::lock_guard lock(mutex_);
    if (sent_ == 0 || unanswered_.front()->id() != id) throw CallError(grpc::StatusCode::DATA_LOSS, "the server answered out of order");
    unanswered_.pop_front();
    --sent_;
    changed_.notify_all();
  }

  /// Everything was asked for and answered.
  bool done() {
    const std::lock_guard lock(mutex_);
    return exhausted_ && unanswered_.empty();
  }

  void set_over(bool over) {
    const std::lock_guard lock(mutex_);
    over_ = over;
    if (!over) sent_ = 0;
    changed_.notify_all();
  }

 private:
  const Next& next_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<v1::EvaluateStreamRequest>> unanswered_;
  std::size_t sent_ = 0;     ///< of them, on this connection
  std::uint64_t count_ = 0;  ///< of all
  bool exhausted_ = false, over_ = false;
};

/// One connection's worth of a stream.
grpc::Status evaluate_on(v1::BrdfService::Stub& stub, grpc::ClientContext& context, Batches& batches, const Answer& answer, Backoff& backoff) {
  const auto stream = stub.EvaluateStream(&context);
  batches.set_over(false);
  std::exception_ptr failed;
  // The server stops reading when its answers are not read, so both directions move at once.
  std::thread writer([&] {
    try {
      for (auto request = batches.take(); request && stream->Write(*request);) request = batches.take();
    } catch (...) {
      failed = std::current_exception();
      context.TryCancel();
    }
    stream->WritesDone();
  });
  const auto finish = [&] {
    batches.set_over(true);
    writer.join();
    return stream->Finish();
  };
  v1::EvaluateStreamResponse response;
  try {
    while (stream->Read(&response)) {
      batches.answered(response.id());
      backoff.progress();
      answer(response.id(), response.response());
    }
  } catch (...) {
    context.TryCancel();
    finish();
    throw;
  }
  grpc::Status status = finish();
  if (failed) std::rethrow_exception(failed);
  return status;
}

struct Compressed {
  v1::Material material;
  bool begun = false;  ///< the server said something
};

/// One connection's worth of a compression.
grpc::Status compress_on(v1::BrdfService::Stub& stub, grpc::ClientContext& context, const v1::CompressOptions& options, std::span<const std::byte> file,
                         const std::function<bool(const std::string&, double)>& progress, Compressed& compressed) {
  const auto stream = stub.Compress(&context);
  std::exception_ptr failed;
  std::thread writer([&] {
    try {
      v1::CompressRequest request;
      *request.mutable_options() = options;
      bool open = stream->Write(request);
      for (std::span<const std::byte> rest = file; open && !rest.empty();) {
        const auto part = rest.first(std::min(rest.size(), chunk_bytes));
        request.set_chunk(part.data(), part.size());
        open = stream->Write(request);
        rest = rest.subspan(part.size());
      }
    } catch (...) {
      failed = std::current_exception();
      context.TryCancel();
    }
    stream->WritesDone();
  });
  const auto finish = [&] {
    writer.join();
    return stream->Finish();
  };
  v1::CompressResponse response;
  try {
    while (stream->Read(&response)) {
      compressed.begun = true;
      if (response.has_material()) compressed.material = response.material();
      if (response.has_progress() && progress && !progress(response.progress().stage(), response.progress().done())) context.TryCancel();
    }
  } catch (...) {
    context.TryCancel();
    finish();
    throw;
  }
  grpc::Status status = finish();
  if (failed) std::rethrow_exception(failed);
  return status;
}

}  // namespace

void Client::evaluate_stream(const Next& next, const Answer& answer, std::chrono::milliseconds deadline) {
  Batches batches(next);
  Backoff backoff(deadline);
  v1::BrdfService::Stub stub(state_->replicas.any());
  for (;;) {
    grpc::ClientContext context;
    state_->prepare(context, backoff.left());
    const grpc::Status status = evaluate_on(stub, context, batches, answer, backoff);
    if (status.ok() && !batches.done()) throw CallError(grpc::StatusCode::DATA_LOSS, "the server ended the stream before it had answered everything");
    if (status.ok()) return;
    if (!backoff.again(status, context)) State::fail(status, context);
  }
}

v1::Material Client::compress(const v1::CompressOptions& options, std::span<const std::byte> file, const std::function<bool(const std::string&, double)>& progress,
                              std::chrono::milliseconds deadline) {
  Backoff backoff(deadline);
  v1::BrdfService::Stub stub(state_->replicas.any());
  for (;;) {
    grpc::ClientContext context;
    state_->prepare(context, backoff.left());
    Compressed compressed;
    const grpc::Status status = compress_on(stub, context, options, file, progress, compressed);
    if (status.ok()) return compressed.material;
    // Once the work has begun, a result may have been published of which the client does not know; a caller who allows to replace it
    // loses nothing by a second.
    if ((compressed.begun && !options.overwrite()) || !backoff.again(status, context)) State::fail(status, context);
  }
}

}  // namespace brdf::client

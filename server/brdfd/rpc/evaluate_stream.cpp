// SPDX-License-Identifier: Apache-2.0
#include "rpc/evaluate_stream.h"

#include "rpc/answers.h"

#include <array>
#include <mutex>
#include <optional>
#include <vector>

namespace brdf::service {

class EvaluateStreams::Stream : public grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse> {
 public:
  Stream(EvaluateStreams& all, Serving& serving, grpc::CallbackServerContext* context) : all_(all), call_(serving, Method::evaluate_stream, context) {}

  void start(const std::shared_ptr<Stream>& self) {
    const std::lock_guard lock(mutex_);
    self_ = self;
    try {
      call_.require(Role::read);
    } catch (...) {
      failure_ = call_.status_of_exception();
    }
    if (call_.serving().ending) ending_ = true;
    if (failure_) {
      maybe_finish();
    } else {
      read_next();
      maybe_finish();
    }
  }

  void end() {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    maybe_finish();
  }

  void OnReadDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    reading_ = false;
    if (!ok) {
      reads_ended_ = true;
      if (!failure_ && is_cut_short(slots_[read_at_].request)) failure_ = unreadable_message();
    } else if (!failure_ && !finished_) {
      Slot& slot = slots_[read_at_];
      read_at_ = (read_at_ + 1) % slots_.size();
      ++held_;
      enqueue(slot);
      read_next();
    }
    maybe_finish();
  }

  void OnWriteDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    Slot& slot = slots_[write_at_];
    slot.ready = false;
    slot.response.Clear();
    write_at_ = (write_at_ + 1) % slots_.size();
    --held_;
    if (!ok && !failure_) failure_ = call_.over();
    write_next();
    read_next();
    maybe_finish();
  }

  void OnDone() override {
    all_.remove(self_);
    const std::shared_ptr<Stream> last = std::move(self_);  // whoever ends it may still hold it
    const std::lock_guard lock(mutex_);  // whoever finished the call may not have let go of it yet
  }

 private:
  struct Slot {
    v1::EvaluateStreamRequest request;
    v1::EvaluateStreamResponse response;
    bool ready = false;
  };

  // All below with the mutex held.

  void read_next() {
    if (reading_ || reads_ended_ || failure_ || ending_ || held_ == slots_.size()) return;
    reading_ = true;
    slots_[read_at_].request.Clear();
    StartRead(&slots_[read_at_].request);
  }

  void write_next() {
    if (writing_ || failure_ || held_ == 0 || !slots_[write_at_].ready) return;
    writing_ = true;
    StartWrite(&slots_[write_at_].response);
  }

  void enqueue(Slot& slot) {
    try {
      PlannedCall planned = plan_evaluate(call_.serving(), slot.request.request(), *slot.response.mutable_response());
      slot.response.set_id(slot.request.id());
      WorkerPool& workers = call_.serving().workers;
      if (!workers.submit(planned.cost, [this, &slot, answer = std::move(planned.answer)] { run(slot, answer); })) {
        call_.overloaded("queue", "this server takes " + std::to_string(workers.capacity()) + " queries at once", workers.expected_wait());
      }
      ++running_;
    } catch (...) {
      failure_ = call_.status_of_exception();
    }
  }

  void fail(const std::exception_ptr& failed) {
    try {
      std::rethrow_exception(failed);
    } catch (...) {
      failure_ = call_.status_of_exception();
    }
  }

  void maybe_finish() {
    const bool drained = (reads_ended_ || ending_) && held_ == 0;
    if (finished_ || writing_ || running_ != 0 || !(failure_ || drained)) return;
    finished_ = true;
    if (ending_ && !reads_ended_ && !failure_) failure_ = grpc::Status(grpc::StatusCode::UNAVAILABLE, "the server ends");
    const grpc::Status status = failure_.value_or(grpc::Status::OK);
    call_.count(status);
    Finish(status);
  }

  // On a worker, without the mutex.
  void run(Slot& slot, const std::function<bool(const Call&)>& answer) {
    std::exception_ptr failed;
    bool over = false;
    try {
      over = call_.is_over() || !answer(call_);
    } catch (...) {
      failed = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    --running_;
    slot.ready = true;
    if (over && !failure_) failure_ = call_.over();
    if (failed && !failure_) fail(failed);
    write_next();
    maybe_finish();
  }

  EvaluateStreams& all_;
  Call call_;
  std::shared_ptr<Stream> self_;
  std::mutex mutex_;
  std::array<Slot, 4> slots_;
  std::size_t read_at_ = 0, write_at_ = 0, held_ = 0, running_ = 0;  // `held_` slots from write_at_ on are in use
  bool reading_ = false, writing_ = false, reads_ended_ = false, ending_ = false, finished_ = false;
  std::optional<grpc::Status> failure_;
};

grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* EvaluateStreams::start(Serving& serving, grpc::CallbackServerContext* context) {
  auto stream = std::make_shared<Stream>(*this, serving, context);
  add(stream);
  stream->start(stream);
  return stream.get();  // it holds itself until OnDone
}

void EvaluateStreams::add(const std::shared_ptr<Stream>& stream) {
  const std::lock_guard lock(mutex_);
  streams_.insert(stream);
}

void EvaluateStreams::remove(const std::shared_ptr<Stream>& stream) {
  const std::lock_guard lock(mutex_);
  streams_.erase(stream);
}

void EvaluateStreams::end() {
  std::vector<std::shared_ptr<Stream>> now;
  {
    const std::lock_guard lock(mutex_);
    now.assign(streams_.begin(), streams_.end());
  }
  for (const auto& stream : now) stream->end();
}

}  // namespace brdf::service

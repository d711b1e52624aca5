// SPDX-License-Identifier: Apache-2.0
#include "rpc/evaluate_stream.h"

#include "rpc/answers.h"

#include <array>
#include <mutex>
#include <optional>

namespace brdf::service {
namespace {

class EvaluateStream : public grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse> {
 public:
  EvaluateStream(Serving& serving, grpc::CallbackServerContext* context) : call_(serving, Method::evaluate_stream, context) {
    try {
      call_.require(Role::read);
    } catch (...) {
      failure_ = call_.status_of_exception();
    }
    const std::lock_guard lock(mutex_);
    if (failure_) {
      maybe_finish();
    } else {
      read_next();
    }
  }

  void OnReadDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    reading_ = false;
    if (!ok) {
      reads_ended_ = true;
    } else if (!failure_) {
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
    { const std::lock_guard lock(mutex_); }  // whoever finished the call may not have let go of it yet
    delete this;
  }

 private:
  struct Slot {
    v1::EvaluateStreamRequest request;
    v1::EvaluateStreamResponse response;
    bool ready = false;
  };

  // All below with the mutex held.

  void read_next() {
    if (reading_ || reads_ended_ || failure_ || held_ == slots_.size()) return;
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
    const bool drained = reads_ended_ && held_ == 0;
    if (finished_ || writing_ || running_ != 0 || !(failure_ || drained)) return;
    finished_ = true;
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

  Call call_;
  std::mutex mutex_;
  std::array<Slot, 4> slots_;
  std::size_t read_at_ = 0, write_at_ = 0, held_ = 0, running_ = 0;  // `held_` slots from write_at_ on are in use
  bool reading_ = false, writing_ = false, reads_ended_ = false, finished_ = false;
  std::optional<grpc::Status> failure_;
};

}  // namespace

grpc::ServerBidiReactor<v1::EvaluateStreamRequest, v1::EvaluateStreamResponse>* start_evaluate_stream(Serving& serving, grpc::CallbackServerContext* context) {
  return new EvaluateStream(serving, context);
}

}  // namespace brdf::service

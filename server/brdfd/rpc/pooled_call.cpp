// SPDX-License-Identifier: Apache-2.0
#include "rpc/pooled_call.h"

namespace brdf::service {
namespace {

/// Lives until it has finished the call; request and response live as long as gRPC keeps them. The reactor is gRPC's own, whose end
/// takes no other thread, which a reactor of our own would.
class PooledCall {
 public:
  PooledCall(Serving& serving, Method method, grpc::CallbackServerContext* context) : call_(serving, method, context), reactor_(context->DefaultReactor()) {}

  grpc::ServerUnaryReactor* reactor() const noexcept { return reactor_; }

  void start(Role role, const std::function<PlannedCall()>& plan) {
    try {
      call_.require(role);
      PlannedCall planned = plan();
      answer_ = std::move(planned.answer);
      WorkerPool& workers = call_.serving().workers;
      // Only one of the job and this function finishes the call, so the job may keep a plain pointer.
      if (planned.brief && workers.run_if_idle(planned.cost, [this] { run(); })) return;
      if (!workers.submit(planned.cost, [this] { run(); })) {
        call_.overloaded("queue", std::to_string(workers.load()) + " queries wait already, this server takes " + std::to_string(workers.capacity()), workers.expected_wait());
      }
    } catch (...) {
      end(call_.status_of_exception());
    }
  }

 private:
  void run() {
    if (call_.is_over()) return end(call_.over());
    try {
      end(answer_(call_) ? grpc::Status::OK : call_.over());
    } catch (...) {
      end(call_.status_of_exception());
    }
  }

  void end(const grpc::Status& status) {
    call_.count(status);
    reactor_->Finish(status);
    delete this;
  }

  Call call_;
  grpc::ServerUnaryReactor* reactor_;
  std::function<bool(const Call&)> answer_;
};

}  // namespace

grpc::ServerUnaryReactor* start_pooled(Serving& serving, Method method, Role role, grpc::CallbackServerContext* context,
                                       const std::function<PlannedCall()>& plan) {
  auto* call = new PooledCall(serving, method, context);
  grpc::ServerUnaryReactor* reactor = call->reactor();
  call->start(role, plan);  // *call may be gone after it
  return reactor;
}

}  // namespace brdf::service

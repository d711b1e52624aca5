// SPDX-License-Identifier: Apache-2.0
#include "rpc/pooled_call.h"

namespace brdf::service {
namespace {

/// Belongs to gRPC until OnDone and to the job until that ran; request and response live as long as gRPC keeps it.
class PooledCall : public grpc::ServerUnaryReactor {
 public:
  PooledCall(Serving& serving, Method method, grpc::CallbackServerContext* context) : call_(serving, method, context) {}

  void start(Role role, const std::function<PlannedCall()>& plan) {
    try {
      call_.require(role);
      PlannedCall planned = plan();
      answer_ = std::move(planned.answer);
      WorkerPool& workers = call_.serving().workers;
      // Only one of the job and this function finishes the call, so the job may keep a plain pointer.
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
    Finish(status);  // *this may be gone after it
  }

  void OnDone() override { delete this; }

  Call call_;
  std::function<bool(const Call&)> answer_;
};

}  // namespace

grpc::ServerUnaryReactor* start_pooled(Serving& serving, Method method, Role role, grpc::CallbackServerContext* context,
                                       const std::function<PlannedCall()>& plan) {
  auto* call = new PooledCall(serving, method, context);
  call->start(role, plan);
  return call;
}

}  // namespace brdf::service

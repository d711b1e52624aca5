// SPDX-License-Identifier: Apache-2.0
#include "server/load/open_loop.h"

#include <thread>

namespace brdf::load {
namespace {

constexpr std::size_t most_under_way = 4000;

}  // namespace

struct OpenLoop::OneCall {
  Context context;
  v1::AlbedoResponse response;
  Clock::time_point start = Clock::now();
};

OpenLoop::OpenLoop(const std::string& address, const v1::AlbedoRequest& request, int connections) : request_(request) {
  for (int i = 0; i < connections; ++i) stubs_.push_back(v1::BrdfService::NewStub(new_channel(address, {{GRPC_ARG_ENABLE_RETRIES, 0}})));
}

OpenLoop::~OpenLoop() { wait_for_all(); }

void OpenLoop::send() {
  if (under_way_ >= most_under_way) {
    ++not_sent_;
    return;
  }
  ++under_way_;
  auto* call = new OneCall;
  stubs_[next_++ % stubs_.size()]->async()->Albedo(&call->context, &request_, &call->response, [this, call](const grpc::Status& status) {
    done(*call, status);
    delete call;
    --under_way_;
  });
}

void OpenLoop::done(OneCall& call, const grpc::Status& status) {
  const double took = seconds_since(call.start);
  if (status.ok()) return accepted_.add(took);
  if (status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED) {
    if (!call.context.GetServerTrailingMetadata().contains("grpc-retry-pushback-ms")) ++without_pushback_;
    return refused_.add(took);
  }
  const std::lock_guard lock(mutex_);
  ++others_[status.error_code()];
}

void OpenLoop::send(double calls_per_second, std::chrono::duration<double> time) {
  const auto start = Clock::now();
  double sent = 0;
  for (double at = 0; (at = seconds_since(start)) < time.count();) {
    for (; sent < at * calls_per_second; ++sent) send();
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  wait_for_all();
}

void OpenLoop::wait_for_all() const {
  while (under_way_ != 0) std::this_thread::sleep_for(std::chrono::microseconds(100));
}

OpenLoop::Counts OpenLoop::take() {
  Counts c;
  c.accepted = accepted_.take();
  c.refused = refused_.take();
  c.without_pushback = without_pushback_.exchange(0);
  c.not_sent = not_sent_.exchange(0);
  const std::lock_guard lock(mutex_);
  c.others.swap(others_);
  return c;
}

}  // namespace brdf::load

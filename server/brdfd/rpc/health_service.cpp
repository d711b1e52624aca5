// SPDX-License-Identifier: Apache-2.0
#include "rpc/health_service.h"

#include <algorithm>
#include <optional>

namespace brdf::service {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

class HealthService::Watcher : public grpc::ServerWriteReactor<HealthCheckResponse> {
 public:
  Watcher(HealthService& health, bool known) : health_(health), known_(known) {}

  void start(const std::shared_ptr<Watcher>& self) {
    self_ = self;
    bool room = false;
    {
      const std::lock_guard lock(health_.mutex_);
      room = health_.watchers_.size() < most_watchers;
      if (room) health_.watchers_.insert(self);
    }
    if (room) return poke();
    const std::lock_guard lock(mutex_);
    finish({grpc::StatusCode::RESOURCE_EXHAUSTED, "too many watchers"});
  }

  void poke() {
    bool serving = false, ended = false;
    {
      const std::lock_guard lock(health_.mutex_);
      serving = health_.serving_;
      ended = health_.ended_;
    }
    const auto status = !known_ ? HealthCheckResponse::SERVICE_UNKNOWN : serving ? HealthCheckResponse::SERVING : HealthCheckResponse::NOT_SERVING;
    const std::lock_guard lock(mutex_);
    if (writing_ || finished_) return;
    if (said_ == status) {
      if (ended) finish({grpc::StatusCode::UNAVAILABLE, "the server ends"});
      return;
    }
    said_ = status;
    response_.set_status(status);
    writing_ = true;
    StartWrite(&response_);
  }

  void OnWriteDone(bool ok) override {
    {
      const std::lock_guard lock(mutex_);
      writing_ = false;
      if (!ok || cancelled_) return finish(grpc::Status::CANCELLED);
    }
    poke();
  }

  void OnCancel() override {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;  // the write under way may still succeed
    if (!writing_) finish(grpc::Status::CANCELLED);
  }

  void OnDone() override {
    {
      const std::lock_guard lock(health_.mutex_);
      health_.watchers_.erase(self_);
    }
    const std::shared_ptr<Watcher> last = std::move(self_);
  }

 private:
  void finish(const grpc::Status& status) {
    if (finished_) return;
    finished_ = true;
    Finish(status);
  }

  HealthService& health_;
  const bool known_;
  std::shared_ptr<Watcher> self_;
  std::mutex mutex_;
  std::optional<HealthCheckResponse::ServingStatus> said_;
  bool writing_ = false, cancelled_ = false, finished_ = false;
  HealthCheckResponse response_;
};

bool HealthService::knows(const std::string& service) const {
  return service.empty() || std::find(services_.begin(), services_.end(), service) != services_.end();
}

grpc::ServerUnaryReactor* HealthService::Check(grpc::CallbackServerContext* context, const HealthCheckRequest* request, HealthCheckResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (!knows(request->service())) {
    reactor->Finish({grpc::StatusCode::NOT_FOUND, "no such service"});
    return reactor;
  }
  {
    const std::lock_guard lock(mutex_);
    response->set_status(serving_ ? HealthCheckResponse::SERVING : HealthCheckResponse::NOT_SERVING);
  }
  reactor->Finish(grpc::Status::OK);
  return reactor;
}

grpc::ServerWriteReactor<HealthCheckResponse>* HealthService::Watch(grpc::CallbackServerContext*, const HealthCheckRequest* request) {
  auto watcher = std::make_shared<Watcher>(*this, knows(request->service()));
  watcher->start(watcher);
  return watcher.get();
}

std::size_t HealthService::watching() const {
  const std::lock_guard lock(mutex_);
  return watchers_.size();
}

void HealthService::poke_all() {
  std::vector<std::shared_ptr<Watcher>> now;
  {
    const std::lock_guard lock(mutex_);
    now.assign(watchers_.begin(), watchers_.end());
  }
  for (const auto& watcher : now) watcher->poke();
}

void HealthService::set_serving(bool serving) {
  {
    const std::lock_guard lock(mutex_);
    serving_ = serving;
  }
  poke_all();
}

void HealthService::end() {
  {
    const std::lock_guard lock(mutex_);
    serving_ = false;
    ended_ = true;
  }
  poke_all();
}

}  // namespace brdf::service

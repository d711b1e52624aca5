// SPDX-License-Identifier: Apache-2.0
#include "rpc/watch.h"

#include "shared/material_name.h"

#include <vector>

namespace brdf::service {
namespace {

constexpr std::size_t changes_of_a_message = 1000;

v1::ChangeKind kind_of(ChangeType type) noexcept {
  switch (type) {
    case ChangeType::added: return v1::CHANGE_KIND_ADDED;
    case ChangeType::replaced: return v1::CHANGE_KIND_REPLACED;
    case ChangeType::removed: return v1::CHANGE_KIND_REMOVED;
  }
  return v1::CHANGE_KIND_UNSPECIFIED;
}

}  // namespace

class Watchers::Watcher : public grpc::ServerWriteReactor<v1::WatchMaterialsResponse> {
 public:
  Watcher(Watchers& all, Serving& serving, grpc::CallbackServerContext* context) : all_(all), call_(serving, Method::watch_materials, context) {}

  void start(const std::shared_ptr<Watcher>& self, bool changes_only) {
    try {
      call_.require(Role::read);
      self_ = self;
      told_ = changes_only ? call_.serving().repository.catalogue() : std::make_shared<const Catalogue>();
      first_ = !changes_only;
      if (!all_.add(self, call_.serving().settings.watchers)) call_.overloaded("watchers", "this server takes " + std::to_string(call_.serving().settings.watchers) + " watchers", std::chrono::seconds(2));
    } catch (...) {
      self_ = self;
      const std::lock_guard lock(mutex_);
      finish(call_.status_of_exception());
      return;
    }
    poke();
  }

  void poke() {
    const std::lock_guard lock(mutex_);
    if (writing_ || finished_) return;
    if (call_.serving().ending) return finish({grpc::StatusCode::UNAVAILABLE, "the server ends"});
    if (pending_.empty()) collect();
    if (pending_.empty()) return;
    message_.Clear();
    for (; next_ < pending_.size() && message_.changes_size() < static_cast<int>(changes_of_a_message); ++next_) {
      const CatalogueChange& c = pending_[next_];
      v1::MaterialChange* m = message_.add_changes();
      m->set_kind(first_ ? v1::CHANGE_KIND_PRESENT : kind_of(c.type));
      m->set_name(material_name(c.material->id));
      m->set_version(version_name(c.material->id, c.material->version));
    }
    if (next_ == pending_.size()) {
      pending_.clear();
      first_ = false;
    }
    writing_ = true;
    StartWrite(&message_);
  }

  void OnWriteDone(bool ok) override {
    {
      const std::lock_guard lock(mutex_);
      writing_ = false;
      if (!ok || cancelled_) return finish(call_.over());
    }
    poke();
  }

  void OnCancel() override {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;  // the write under way may still succeed
    if (!writing_) finish(call_.over());
  }

  void OnDone() override {
    all_.remove(self_);
    const std::shared_ptr<Watcher> last = std::move(self_);  // whoever pokes may still hold it
  }

 private:
  void collect() {
    const CatalogueHandle now = call_.serving().repository.catalogue();
    pending_ = changes_between(*told_, *now);
    told_ = now;
    next_ = 0;
    if (pending_.empty()) first_ = false;
  }

  void finish(const grpc::Status& status) {
    if (finished_) return;
    finished_ = true;
    call_.count(status);
    Finish(status);
  }

  Watchers& all_;
  Call call_;
  std::shared_ptr<Watcher> self_;
  std::mutex mutex_;
  CatalogueHandle told_;
  std::vector<CatalogueChange> pending_;
  std::size_t next_ = 0;
  bool first_ = true, writing_ = false, cancelled_ = false, finished_ = false;
  v1::WatchMaterialsResponse message_;
};

grpc::ServerWriteReactor<v1::WatchMaterialsResponse>* Watchers::start(Serving& serving, grpc::CallbackServerContext* context, const v1::WatchMaterialsRequest* request) {
  auto watcher = std::make_shared<Watcher>(*this, serving, context);
  watcher->start(watcher, request->changes_only());
  return watcher.get();  // it holds itself until OnDone
}

bool Watchers::add(const std::shared_ptr<Watcher>& watcher, std::uint64_t most) {
  const std::lock_guard lock(mutex_);
  if (watchers_.size() >= most) return false;
  watchers_.insert(watcher);
  return true;
}

void Watchers::remove(const std::shared_ptr<Watcher>& watcher) {
  const std::lock_guard lock(mutex_);
  watchers_.erase(watcher);
}

void Watchers::poke() {
  std::vector<std::shared_ptr<Watcher>> now;
  {
    const std::lock_guard lock(mutex_);
    now.assign(watchers_.begin(), watchers_.end());
  }
  for (const auto& watcher : now) watcher->poke();
}

}  // namespace brdf::service

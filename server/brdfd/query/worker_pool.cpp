// SPDX-License-Identifier: Apache-2.0
#include "query/worker_pool.h"

#include <algorithm>

namespace brdf::service {

WorkerPool::WorkerPool(std::size_t threads, std::uint64_t capacity) : capacity_(capacity) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& t : threads_) t.join();
}

bool WorkerPool::submit(std::uint64_t cost, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    if (load_ != 0 && (cost > capacity_ || load_ > capacity_ - cost)) return false;
    queue_.push_back({cost, std::move(job)});
    load_ += cost;
  }
  changed_.notify_one();
  return true;
}

bool WorkerPool::run_if_idle(std::uint64_t cost, const std::function<void()>& job) {
  {
    const std::lock_guard lock(mutex_);
    if (load_ != 0) return false;
    load_ += cost;
  }
  job();
  const std::lock_guard lock(mutex_);
  load_ -= cost;
  return true;
}

std::chrono::milliseconds WorkerPool::expected_wait() const {
  const std::lock_guard lock(mutex_);
  const double seconds = static_cast<double>(load_) * seconds_per_cost_ / static_cast<double>(std::max<std::size_t>(threads_.size(), 1));
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::clamp(1000 * seconds, 10.0, 2000.0)));
}

std::uint64_t WorkerPool::load() const {
  const std::lock_guard lock(mutex_);
  return load_;
}

void WorkerPool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !queue_.empty(); });
    if (queue_.empty()) return;
    Job job = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    job.run();
    job.run = nullptr;  // what it holds is released outside of the lock
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    lock.lock();
    load_ -= job.cost;
    const double pace = took.count() / static_cast<double>(std::max<std::uint64_t>(job.cost, 1));
    seconds_per_cost_ += (pace - seconds_per_cost_) * (seconds_per_cost_ > 0 ? 0.05 : 1.0);
  }
}

}  // namespace brdf::service

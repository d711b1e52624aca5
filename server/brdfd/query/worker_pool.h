// SPDX-License-Identifier: Apache-2.0
// Threads that work, and a queue that says no.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace brdf::service {

/// The queue is bounded by what its jobs cost (queries, bytes), because a thousand small jobs may wait where ten large ones
/// would take seconds. What runs counts until it is done. Thread-safe.
class WorkerPool {
 public:
  WorkerPool(std::size_t threads, std::uint64_t capacity);
  /// Runs what is queued, then ends the threads.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// False where the queue is full. One job is always taken when nothing is there, however large. `job` must not throw.
  bool submit(std::uint64_t cost, std::function<void()> job);

  /// Runs `job` here and now where nothing waits or runs; false otherwise. It counts as if a worker ran it, so that at most one such job
  /// runs at a time and what comes meanwhile is queued. For jobs that take less time than waking a worker. `job` must not throw.
  bool run_if_idle(std::uint64_t cost, const std::function<void()>& job);

  /// How long what is there takes, by the pace of the last jobs: 10 ms to 2 s.
  std::chrono::milliseconds expected_wait() const;

  std::uint64_t load() const;  ///< cost of what waits and runs
  std::uint64_t capacity() const noexcept { return capacity_; }
  std::size_t threads() const noexcept { return threads_.size(); }

 private:
  struct Job {
    std::uint64_t cost;
    std::function<void()> run;
  };
  void work();

  const std::uint64_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> queue_;
  std::uint64_t load_ = 0;
  double seconds_per_cost_ = 0;  ///< of one thread, a running mean
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace brdf::service

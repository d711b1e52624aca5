// SPDX-License-Identifier: Apache-2.0
// Times of calls.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

namespace brdf::load {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The value that a share of them does not exceed; 0 of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

/// Thread-safe.
class Latencies {
 public:
  void add(double seconds) {
    const std::lock_guard lock(mutex_);
    seconds_.push_back(seconds);
  }
  std::vector<double> take() {
    const std::lock_guard lock(mutex_);
    return std::move(seconds_);
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return seconds_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<double> seconds_;
};

}  // namespace brdf::load

// SPDX-License-Identifier: Apache-2.0
// Lets solver runs on several threads report to, and be stopped by, one caller.
#pragma once

#include <brdf/error.h>
#include <brdf/progress.h>

#include <atomic>
#include <exception>

namespace brdf::fit {

class ProgressGate {
 public:
  explicit ProgressGate(const Progress& progress) : progress_(progress) {}

  /// Share of the whole work that is done; never goes back.
  void advance_to(double done) noexcept { done_ = done > done_ ? done : done_; }

  /// Called between solver iterations; returns whether to go on. Only the caller's own thread calls the user's
  /// function, as Progress promises. What that function throws is kept until throw_if_stopped, so that it does not
  /// unwind through the solver.
  bool tick(bool on_caller) noexcept {
    if (stopped_.load(std::memory_order_relaxed)) return false;
    if (!on_caller || !progress_) return true;
    try {
      if (progress_("fit", done_)) return true;
    } catch (...) {
      thrown_ = std::current_exception();
    }
    stopped_.store(true, std::memory_order_relaxed);
    return false;
  }

  void throw_if_stopped() const {
    if (thrown_) std::rethrow_exception(thrown_);
    if (stopped_.load()) throw Error(ErrorCode::cancelled, "the fit was cancelled by its progress callback");
  }

 private:
  const Progress& progress_;
  double done_ = 0;
  std::atomic<bool> stopped_{false};
  std::exception_ptr thrown_;
};

}  // namespace brdf::fit

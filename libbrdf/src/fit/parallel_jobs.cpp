// SPDX-License-Identifier: Apache-2.0
#include "fit/parallel_jobs.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace brdf::fit {

void run_jobs(std::size_t count, int threads, const std::function<void(std::size_t i, bool on_caller)>& job) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&](bool on_caller) noexcept {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      try {
        job(i, on_caller);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    }
  };
  {
    const std::size_t workers = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
    std::vector<std::jthread> others;  // joined at the end of this block
    for (std::size_t t = 1; t < workers; ++t) others.emplace_back(work, false);
    work(true);
  }
  for (const std::exception_ptr& e : thrown) {
    if (e) std::rethrow_exception(e);
  }
}

}  // namespace brdf::fit

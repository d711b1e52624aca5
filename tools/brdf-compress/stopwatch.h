// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

namespace brdf::cli {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds that one call of `work` takes: the median over repeats, each long enough for the clock.
template <class Work>
double median_seconds(Work&& work) {
  constexpr double least = 1e-3;
  constexpr std::size_t repeats = 9;
  std::size_t calls = 1;
  for (;;) {  // also warms up
    const Stopwatch watch;
    for (std::size_t i = 0; i < calls; ++i) work();
    if (watch.seconds() >= least) break;
    calls *= 2;
  }
  std::array<double, repeats> seconds;
  for (double& s : seconds) {
    const Stopwatch watch;
    for (std::size_t i = 0; i < calls; ++i) work();
    s = watch.seconds() / static_cast<double>(calls);
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 2, seconds.end());
  return seconds[repeats / 2];
}

}  // namespace brdf::cli

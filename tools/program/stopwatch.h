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

/// Seconds that one call of `work` takes: the lower quartile over repeats, each long enough for the clock. What else runs on
/// the machine only ever adds, so the quicker repeats are nearer to the truth, and one alone may be luck.
template <class Work>
double undisturbed_seconds(Work&& work) {
  constexpr double least = 1e-3;
  constexpr std::size_t repeats = 16;
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
  std::nth_element(seconds.begin(), seconds.begin() + repeats / 4, seconds.end());
  return seconds[repeats / 4];
}

}  // namespace brdf::cli

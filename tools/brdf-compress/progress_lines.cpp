// SPDX-License-Identifier: Apache-2.0
#include "progress_lines.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

namespace brdf::cli {

Progress progress_lines(int descriptor) {
  struct Last {
    std::string stage;
    double done = 0;
    std::chrono::steady_clock::time_point when{};
  };
  return [descriptor, last = std::make_shared<Last>()](std::string_view stage, double done) {
    const auto now = std::chrono::steady_clock::now();
    if (stage == last->stage && now - last->when < std::chrono::milliseconds(100)) return true;
    last->stage = stage;
    last->done = std::clamp(done, last->done, 1.0);
    last->when = now;
    char share[32];
    const int n = std::snprintf(share, sizeof(share), "%.4f ", last->done);
    const std::string line = std::string(share, static_cast<std::size_t>(n)) + last->stage + "\n";
    [[maybe_unused]] const auto written = ::write(descriptor, line.data(), line.size());
    return true;
  };
}

}  // namespace brdf::cli

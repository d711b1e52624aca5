// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace brdf::cli {

ProgressBar::ProgressBar(const Reporting& reporting) : enabled_(!reporting.quiet && ::isatty(STDERR_FILENO) != 0) {}

void ProgressBar::show(std::string_view stage, double done) {
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr int width = 30;
  const double share = std::clamp(done, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(share * width));
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %.*s", bar.c_str(), share * 100,
               static_cast<int>(std::min<std::size_t>(stage.size(), 40)), stage.data());
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

Progress ProgressBar::callback(double begin, double end) {
  return [this, begin, end](std::string_view stage, double done) {
    show(stage, begin + (end - begin) * done);
    return true;
  };
}

}  // namespace brdf::cli

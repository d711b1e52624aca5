// SPDX-License-Identifier: Apache-2.0
#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace brdf::cli {
namespace {

/// "0:07", "12:30", "3:05:00".
std::string shown_time(double seconds) {
  const long whole = std::lround(std::min(seconds, 1e9));
  char text[32];
  if (whole < 3600) std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  else std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  return text;
}

}  // namespace

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
  const double seconds = std::chrono::duration<double>(now - start_).count();
  // what the first moments promise is worth nothing
  const std::string left = seconds > 1 && share > 0.01 ? ", " + shown_time(seconds * (1 - share) / share) + " left" : "";
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s%s  %.*s", bar.c_str(), share * 100, shown_time(seconds).c_str(), left.c_str(),
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

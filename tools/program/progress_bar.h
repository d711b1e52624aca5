// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "messages.h"

#include <brdf/progress.h>

#include <chrono>
#include <string_view>

namespace brdf::cli {

/// One line on stderr, with the time since it was made and what is left by its share, that is redrawn and taken away at the end. Shown on a terminal only, and not with -q.
class ProgressBar {
 public:
  explicit ProgressBar(const Reporting& reporting);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(std::string_view stage, double done);
  void clear();

  /// For calls of the library; `begin` to `end` is the share of the whole work that the call has.
  Progress callback(double begin = 0, double end = 1);

 private:
  bool enabled_, drawn_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_{};
};

}  // namespace brdf::cli

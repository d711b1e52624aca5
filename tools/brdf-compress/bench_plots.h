// SPDX-License-Identifier: Apache-2.0
// Plots of the rows of `bench`, drawn by matplotlib: plot_tradeoff.py is part of the program and runs in a Python of its
// own.
#pragma once

#include <filesystem>
#include <string>

namespace brdf::cli {

class BenchPlots {
 public:
  /// Makes sure that what write() needs is there, before rows are measured for minutes. Throws Failure(failed) for a
  /// folder that cannot be made, one that holds plots already unless `force`, and where no Python finds matplotlib.
  BenchPlots(std::filesystem::path folder, bool force);

  /// Writes tradeoff.json (`report`, the plotted rows) and the plots as SVG and PNG. Throws Failure(failed).
  void write(const std::string& report) const;

 private:
  std::filesystem::path folder_;
  std::string python_;
};

}  // namespace brdf::cli

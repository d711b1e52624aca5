// SPDX-License-Identifier: Apache-2.0
// One run of the solver.
#pragma once

#include "fit/parameters.h"
#include "fit/prepared_samples.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace brdf::fit {

struct SolveLimits {
  std::size_t samples = 0;  ///< of the prefix that carries the loss
  int iterations = 0;
  double tolerance = 1e-6;  ///< relative change of the cost at which it stops
};

struct Solution {
  std::vector<double> parameters;
  double mean_loss = 0;  ///< weighted mean of rho over samples and channels: about the squared RMS log ratio
  std::string message;
  double seconds = 0;
};

/// `keep_going` is asked after every iteration; when it answers false the run ends early with what it has.
Solution solve(const PreparedSamples& samples, const Layout& layout, const std::vector<double>& start,
               const SolveLimits& limits, const std::function<bool()>& keep_going);

/// mean_loss of given parameters over the first `count` samples.
double mean_loss(const PreparedSamples& samples, const Layout& layout, const std::vector<double>& p, std::size_t count);

}  // namespace brdf::fit

// SPDX-License-Identifier: Apache-2.0
#include "fit/collect_samples.h"
#include "fit/fit_samples.h"

#include <brdf/fit.h>

#include <chrono>

namespace brdf {

FitResult fit_lobes(const Measurement& m, const FitOptions& options, const Progress& progress) {
  fit::require_valid(options);
  const auto begun = std::chrono::steady_clock::now();
  FitResult result = fit::fit_samples(fit::collect_samples(m, options.samples), options, progress);
  result.summary.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// Finds the fewest lobes that the samples require.
#pragma once

#include "fit/prepared_samples.h"
#include "fit/progress_gate.h"

#include <brdf/fit.h>

#include <string>
#include <vector>

namespace brdf::fit {

/// A lobe that was tried.
struct Trial {
  enum class Outcome { kept, refused, removed };
  LobeKind kind = LobeKind::lambert;
  double before = 0, after = 0;  ///< criterion without and with it
  Outcome outcome = Outcome::refused;
  double alpha = 0;  ///< of the final set where kept, of the trial otherwise
  bool instead_of_lambert = false;
  bool screened = false;  ///< criteria are those of the prefix on which starting points are compared
};

struct SearchResult {
  LobeSet lobes;              ///< unit scale, the channels of the prepared samples
  std::vector<Trial> trials;  ///< in the order tried
  std::string stop_reason, solver_message;
  double cost = 0;      ///< 1/2 sum of weight rho
  double required = 0;  ///< gain that a lobe had to bring
  int solver_runs = 0;
  double seconds_solver = 0;
};

/// Starts with one Lambert lobe. Each round tries the moves that fit into max_lobes - another ggx, a retro lobe, ggx in
/// place of Lambert, leaving a lobe out - from several starts on a prefix of the samples, finishes the promising ones
/// on all of them and takes the best, until no move gains enough. `samples.scale` is above 0.
SearchResult search_lobes(const PreparedSamples& samples, const FitOptions& options, ProgressGate& gate);

}  // namespace brdf::fit

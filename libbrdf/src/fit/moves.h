// SPDX-License-Identifier: Apache-2.0
// The steps of the search from one set of lobes to the next.
#pragma once

#include "fit/prepared_samples.h"

#include <brdf/fit.h>
#include <brdf/lobes.h>

#include <cstddef>
#include <vector>

namespace brdf::fit {

/// A changed set of lobes, once per starting point.
struct Move {
  enum class Action { add, replace, remove };
  Action action = Action::add;
  std::size_t index = 0;              ///< of the lobe removed or replaced; an added one comes last
  LobeKind kind = LobeKind::lambert;  ///< added; or removed
  std::vector<LobeSet> starts;
};

/// All moves from `present` that options allow. `newest` is the index of the lobe added last, which is not tried for
/// removal at once. `screening` samples suffice to choose starting points.
std::vector<Move> possible_moves(const PreparedSamples& samples, std::size_t screening, const LobeSet& present,
                                 std::size_t newest, const FitOptions& options);

}  // namespace brdf::fit

// SPDX-License-Identifier: Apache-2.0
// The best file of at most so many bytes.
#pragma once

#include "encode/candidate.h"
#include "encode/verification.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace brdf::encode {

/// What all candidates of one material share.
struct SearchSpace {
  const Measurement& measurement;
  const container::Content& frame;
  std::vector<residual::BasisCodes> bases;  ///< at least one, the usual one first
  bool reciprocal;
  const EffortStep& effort;
  const metrics::QuerySet& queries;
  int threads;
};

/// Tries every basis and, for a measurement that was taken in slices, its own coordinates; chooses by measuring the
/// decoded files. `done` hears of each candidate, a share of 1. The result does not depend on the number of threads.
/// Empty bytes when only the lobes fit.
Encoded encode_to_size(const SearchSpace& space, std::uint64_t bytes, const std::function<void(double share)>& done);

}  // namespace brdf::encode

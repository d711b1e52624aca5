// SPDX-License-Identifier: Apache-2.0
// The best file of at most so many bytes.
#pragma once

#include "encode/recipes.h"
#include "encode/verification.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace brdf::encode {

/// A file and what it was measured to be worth.
struct Found {
  Encoded file;
  double merit = -1e9;
  ErrorReport report;
  bool reciprocity_was_open = false;       ///< both parities were tried
  double one_way = -1e9, reciprocal = -1e9;  ///< merit of the best file of each parity
};

/// What a search at one level needs besides its source.
struct Search {
  const std::vector<residual::BasisCodes>& bases;  ///< at least one, the usual one first
  Parities parities;
  EvalLevel level;
  const Verification& verification;  ///< of a quality at which candidates are told apart
  int threads;
  bool exhaustive = true;            ///< more coefficients than the effort has, where a target error asks for them
};

/// Tries every recipe and chooses by measuring the decoded files; a smaller file that is as good wins. `done` hears of each
/// recipe, a share of 1. The result does not depend on the number of threads. Never worse than the lobes alone, which
/// must fit.
Found encode_to_size(const SourceData& source, const Search& search, std::uint64_t bytes, const std::function<void(double share)>& done);

}  // namespace brdf::encode

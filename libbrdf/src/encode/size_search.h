// SPDX-License-Identifier: Apache-2.0
// The best file of at most so many bytes.
#pragma once

#include "encode/recipes.h"
#include "encode/verification.h"

#include <cstdint>
#include <functional>
#include <array>
#include <vector>

namespace brdf::encode {

/// A file and what it was measured to be worth.
struct Found {
  Encoded file;
  double merit = -1e9;
  ErrorReport report;
  std::array<double, 3> of_azimuth{-1e9, -1e9, -1e9};  ///< merit of the best file of each residual::Azimuth that was tried

  /// Merit that keeping an asymmetry brings, in dB; 0 where only one of both was tried.
  double gain(residual::Azimuth kept, residual::Azimuth averaged) const noexcept {
    const double a = of_azimuth[static_cast<std::size_t>(kept)], b = of_azimuth[static_cast<std::size_t>(averaged)];
    return a > -1e9 && b > -1e9 ? a - b : 0.0;
  }
};

/// What a search at one level needs besides its source.
struct Search {
  const std::vector<residual::BasisCodes>& bases;  ///< at least one, the usual one first
  const Azimuths& azimuths;
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

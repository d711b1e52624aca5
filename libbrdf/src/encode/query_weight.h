// SPDX-License-Identifier: Apache-2.0
// What a scene asked, as weights of everything that the encoder minimises. The one place where a profile enters:
//
//   weight = (1 - asked_share) * the usual weight + asked_share * density of the profile,      both with the same sum,
//
// for the samples of the fit, the cells of the error model (and, through them, the nodes of slices) and the merit of a file.
// The small rest keeps regions sane that nobody asked for.
#pragma once

#include "encode/bins.h"
#include "fit/sample_set.h"

#include <brdf/fit.h>
#include <brdf/measurement.h>
#include <brdf/profile.h>
#include <brdf/progress.h>

#include <span>
#include <vector>

namespace brdf::encode {

inline constexpr double asked_share = 0.98;

class QueryWeight {
 public:
  /// Keeps nothing by reference. Throws Error(no_data) when the profile asks nothing of the measurement.
  QueryWeight(const Measurement& m, const MaterialProfile& asked);

  /// `weights`, of the cells of `bins`, become the mixture; their sum stays.
  void blend(const Bins& bins, const residual::Basis& basis, std::vector<double>& weights) const;

  /// `count` samples where the scene asked and half as many where fit_lobes takes them, in turn.
  fit::SampleSet samples(const Measurement& m, int count) const;

 private:
  struct Cell {
    std::size_t index;
    double share;   ///< of the contribution
    double scale;   ///< mean f of the measurement there
  };
  std::vector<Cell> cells_;  ///< those with a contribution
};

/// As brdf::fit_lobes, for what the scene asked; without `weight` the same as that.
FitResult fit_asked(const Measurement& m, const FitOptions& options, const QueryWeight* weight, const Progress& progress = {});

}  // namespace brdf::encode

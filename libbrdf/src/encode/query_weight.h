// SPDX-License-Identifier: Apache-2.0
// What a scene asked, as weights of everything that the encoder minimises. The one place where a profile enters:
//
//   weight = (1 - a) * the usual weight + a * density of the profile,      both with the same sum,
//
// for the samples of the fit, the cells of the error model (and, through them, the nodes of slices) and the merit of a file.
// The small rest keeps regions sane that nobody asked for. An error model is an approximation, so files of several a are made
// and measured, the usual ones (a = 0) among them: a profile never makes a file worse where the scene looks.
#pragma once

#include "encode/bins.h"
#include "encode/effort.h"
#include "fit/sample_set.h"

#include <brdf/fit.h>
#include <brdf/measurement.h>
#include <brdf/profile.h>
#include <brdf/progress.h>

#include <span>
#include <vector>

namespace brdf::encode {

inline constexpr double asked_share = 0.98;  ///< a of the merit, and of the files that are tried first
inline constexpr double careful_share = 0.6;

class QueryWeight {
 public:
  /// Keeps nothing by reference. Throws Error(no_data) when the profile asks nothing of the measurement.
  QueryWeight(const Measurement& m, const MaterialProfile& asked, double share);
  double share() const noexcept { return share_; }

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
  double share_;             ///< a
  std::vector<Cell> cells_;  ///< those with a contribution
};

/// Those that an effort tries, the one that follows the profile most closely first; none without a profile.
std::vector<QueryWeight> query_weights(const Measurement& m, const MaterialProfile* asked, const EffortStep& effort);

/// As brdf::fit_lobes, for what the scene asked; without `weight` the same as that.
FitResult fit_asked(const Measurement& m, const FitOptions& options, const QueryWeight* weight, const Progress& progress = {});

}  // namespace brdf::encode

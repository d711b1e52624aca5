// SPDX-License-Identifier: Apache-2.0
/// @file fit.h
/// Fits a sum of analytic lobes to a measurement (Ceres).
#pragma once

#include <brdf/lobes.h>
#include <brdf/measurement.h>
#include <brdf/progress.h>

#include <string>
#include <vector>

namespace brdf {

struct FitOptions {
  int max_lobes = 4;          ///< upper bound of the search, 1 to 8
  int starts = 4;             ///< starting points per candidate, at least 1
  int max_iterations = 60;    ///< of the solver, per start
  int samples = 6000;         ///< direction pairs that carry the loss, at least 100
  int threads = 1;            ///< over starts; the result does not depend on it
  bool retro = true;          ///< try a retro-reflective lobe
  bool is_valid(std::string* why = nullptr) const;
};

/// Why a lobe is there.
struct LobeReason {
  LobeKind kind;
  double criterion_before = 0, criterion_after = 0;  ///< Bayesian information criterion without and with it
  bool kept = false;
  std::string sentence;
};

struct FitSummary {
  std::string stop_reason;       ///< one sentence: why the search ended
  std::string solver_message;    ///< of the solver's last accepted run
  std::vector<LobeReason> lobes; ///< in the order tried, refused ones included
  double cost = 0;               ///< final robust weighted cost
  int solver_runs = 0;
  double seconds_total = 0, seconds_solver = 0;
  std::string brief() const;     ///< one line
  std::string full() const;      ///< a few lines
};

struct FitResult {
  LobeSet lobes;
  FitSummary summary;
};

/// Throws Error: invalid_argument, no_data, cancelled. Deterministic for any number of threads.
FitResult fit_lobes(const Measurement& m, const FitOptions& options = {}, const Progress& progress = {});

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
#include "fit/fit_samples.h"

#include "fit/channel_colors.h"
#include "fit/prepared_samples.h"
#include "fit/search.h"
#include "fit/trial_sentence.h"

#include <brdf/error.h>

#include <chrono>
#include <utility>

namespace brdf::fit {
namespace {

FitResult all_zero(int channels) {
  FitResult result;
  result.lobes.channels = channels;
  Lobe black;
  black.color.assign(static_cast<std::size_t>(channels), 0.0);
  result.lobes.lobes.push_back(std::move(black));
  result.summary.stop_reason = "every valid sample is 0: one Lambert lobe of colour 0";
  result.summary.solver_message = "not run";
  result.summary.lobes.push_back({LobeKind::lambert, 0, 0, true, result.summary.stop_reason});
  return result;
}

}  // namespace

void require_valid(const FitOptions& options) {
  std::string why;
  if (!options.is_valid(&why)) throw Error(ErrorCode::invalid_argument, why);
}

FitResult fit_samples(const SampleSet& set, const FitOptions& options, const Progress& progress) {
  require_valid(options);
  if (set.channels < 1 || set.size() == 0) {
    throw Error(ErrorCode::no_data, "the measurement holds no valid value with both angles at most 85 degrees");
  }
  const auto begun = std::chrono::steady_clock::now();
  ProgressGate gate(progress);
  gate.tick(true);
  gate.throw_if_stopped();

  const PreparedSamples prepared = prepare_samples(set);
  if (!(prepared.scale > 0)) return all_zero(set.channels);
  SearchResult found = search_lobes(prepared, options, gate);

  FitResult result;
  result.lobes = std::move(found.lobes);
  if (set.channels > prepared.channels) {
    result.lobes = fit_channel_colors(set, prepared, result.lobes, options.threads,
                                      [&](bool on_caller) { return gate.tick(on_caller); });
    gate.throw_if_stopped();
  }
  clear_invisible_colors(prepared, result.lobes);
  for (Lobe& lobe : result.lobes.lobes) {
    for (double& c : lobe.color) c *= prepared.scale;
    if (lobe.kind != LobeKind::lambert) lobe.f90 *= prepared.scale;
  }
  gate.advance_to(1);
  gate.tick(true);
  gate.throw_if_stopped();

  FitSummary& summary = result.summary;
  for (const Trial& trial : found.trials) {
    summary.lobes.push_back({trial.kind, trial.before, trial.after, trial.outcome == Trial::Outcome::kept,
                             trial_sentence(trial, found.required)});
  }
  summary.stop_reason = std::move(found.stop_reason);
  summary.solver_message = std::move(found.solver_message);
  summary.cost = found.cost;
  summary.solver_runs = found.solver_runs;
  summary.seconds_solver = found.seconds_solver;
  summary.seconds_total = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

}  // namespace brdf::fit

// SPDX-License-Identifier: Apache-2.0
#include "fit/search.h"

#include "fit/criterion.h"
#include "fit/moves.h"
#include "fit/parallel_jobs.h"
#include "fit/solve.h"
#include "fit/starting_point.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace brdf::fit {
namespace {

using Action = Move::Action;

constexpr std::size_t no_lobe = std::numeric_limits<std::size_t>::max();
constexpr int screening_iterations = 15;

/// A set of lobes with its standing on all samples and on the screening prefix.
struct Fitted {
  LobeSet lobes;
  double mean_loss = 0, criterion = 0, screened = 0;
};

class Search {
 public:
  Search(const PreparedSamples& samples, const FitOptions& options, ProgressGate& gate)
      : samples_(samples), options_(options), gate_(gate) {
    screening_ = std::min(samples.size(), std::max<std::size_t>(samples.size() / 6, 400));
    required_ = required_gain(samples.independent);
  }

  SearchResult run() {
    start_with_lambert();
    std::size_t newest = no_lobe;
    // every accepted pair of an addition and a removal lowers the criterion, so the bound is a safeguard only
    for (int round = 0; round < 3 * options_.max_lobes + 2; ++round) {
      gate_.advance_to(round / (2.0 * options_.max_lobes + 1));
      const bool full = present_.lobes.lobes.size() >= static_cast<std::size_t>(options_.max_lobes);
      if (!step(newest)) {
        result_.stop_reason = why_stopped(full);
        break;
      }
    }
    finish();
    return std::move(result_);
  }

 private:
  double criterion_of(const LobeSet& set, double loss) const {
    return information_criterion(loss, samples_.independent, layout_of(set).size());
  }

  /// Runs the solver once per set, on `count` samples, in parallel.
  std::vector<Solution> solve_all(const std::vector<const LobeSet*>& starts, std::size_t count, int iterations,
                                  double tolerance) {
    std::vector<Solution> solutions(starts.size());
    run_jobs(starts.size(), options_.threads, [&](std::size_t i, bool on_caller) {
      solutions[i] = solve(samples_, layout_of(*starts[i]), to_parameters(*starts[i]), {count, iterations, tolerance},
                           [&] { return gate_.tick(on_caller); });
    });
    gate_.throw_if_stopped();
    result_.solver_runs += static_cast<int>(starts.size());
    for (const Solution& s : solutions) result_.seconds_solver += s.seconds;
    return solutions;
  }

  Fitted finish_on_all(const LobeSet& start, std::string& message) {
    Solution s = solve_all({&start}, samples_.size(), options_.max_iterations, 1e-6).front();
    Fitted f;
    const Layout layout = layout_of(start);
    f.lobes = from_parameters(layout, s.parameters);
    f.mean_loss = s.mean_loss;
    f.criterion = criterion_of(start, s.mean_loss);
    f.screened = criterion_of(start, mean_loss(samples_, layout, s.parameters, screening_));
    message = std::move(s.message);
    return f;
  }

  void start_with_lambert() {
    LobeSet nothing;
    nothing.channels = samples_.channels;
    LobeSet start = nothing;
    start.lobes.push_back(starting_lambert(samples_));
    present_ = finish_on_all(start, result_.solver_message);
    const double before = criterion_of(nothing, mean_loss(samples_, layout_of(nothing), {}, samples_.size()));
    result_.trials.push_back({LobeKind::lambert, before, present_.criterion, Trial::Outcome::kept, 0, false, false});
    trial_of_.push_back(0);
  }

  /// Gain beyond what the move has to bring; above 0 it is taken. Leaving a lobe out may cost what a lobe has to gain.
  double merit(const Move& move, double before, double after) const {
    return before - after + (move.action == Action::remove ? required_ : -required_);
  }

  /// Tries every move; takes the best. False when none is worth it.
  bool step(std::size_t& newest) {
    const std::vector<Move> moves = possible_moves(samples_, screening_, present_.lobes, newest, options_);
    std::vector<const LobeSet*> starts;
    for (const Move& move : moves) {
      for (const LobeSet& set : move.starts) starts.push_back(&set);
    }
    const std::vector<Solution> solutions =
        solve_all(starts, screening_, std::min(options_.max_iterations, screening_iterations), 1e-4);

    struct Screened {
      const Move* move;
      LobeSet best;
      double criterion, merit;
    };
    std::vector<Screened> screened;
    std::size_t at = 0;
    for (const Move& move : moves) {
      std::size_t best = at;
      for (std::size_t i = at; i < at + move.starts.size(); ++i) {
        if (solutions[i].mean_loss < solutions[best].mean_loss) best = i;
      }
      const Layout layout = layout_of(*starts[best]);
      const double criterion = criterion_of(*starts[best], solutions[best].mean_loss);
      screened.push_back({&move, from_parameters(layout, solutions[best].parameters), criterion,
                          merit(move, present_.screened, criterion)});
      at += move.starts.size();
    }
    std::stable_sort(screened.begin(), screened.end(),
                     [](const Screened& a, const Screened& b) { return a.merit > b.merit; });

    bool addition_finished = false;
    for (const Screened& s : screened) {
      const bool addition = s.move->action != Action::remove;
      // a prefix and few iterations may hide a gain, so the best addition gets its chance in full whatever it showed
      const bool promising = s.merit > 0 || (addition ? !addition_finished : s.merit > -required_);
      if (!promising) {
        record(*s.move, s.best, present_.screened, s.criterion, Trial::Outcome::refused, true);
        continue;
      }
      addition_finished = addition_finished || addition;
      std::string message;
      Fitted fitted = finish_on_all(s.best, message);
      if (merit(*s.move, present_.criterion, fitted.criterion) > 0) {
        accept(*s.move, std::move(fitted), newest);
        result_.solver_message = std::move(message);
        return true;
      }
      record(*s.move, fitted.lobes, present_.criterion, fitted.criterion, Trial::Outcome::refused);
    }
    return false;
  }

  void record(const Move& move, const LobeSet& lobes, double before, double after, Trial::Outcome outcome,
              bool screened = false) {
    if (move.action == Action::remove) return;  // that a lobe was not removed is no news
    Trial trial{move.kind, before, after, outcome, lobes.lobes.back().alpha, move.action == Action::replace, screened};
    result_.trials.push_back(trial);
  }

  void accept(const Move& move, Fitted fitted, std::size_t& newest) {
    if (move.action != Action::add) {
      Trial& gone = result_.trials[trial_of_[move.index]];
      gone.outcome = Trial::Outcome::removed;
      if (move.action == Action::remove) {
        gone.before = fitted.criterion;
        gone.after = present_.criterion;
      }
      trial_of_.erase(trial_of_.begin() + static_cast<std::ptrdiff_t>(move.index));
      newest = no_lobe;
    }
    if (move.action != Action::remove) {
      record(move, fitted.lobes, present_.criterion, fitted.criterion, Trial::Outcome::kept);
      trial_of_.push_back(result_.trials.size() - 1);
      newest = fitted.lobes.lobes.size() - 1;
    }
    present_ = std::move(fitted);
  }

  std::string why_stopped(bool full) const {
    const std::vector<Lobe>& lobes = present_.lobes.lobes;
    const std::string alone =
        lobes.size() == 1 && lobes[0].kind == LobeKind::lambert ? "one Lambert lobe describes the measurement: " : "";
    return alone + (full ? "the limit of lobes is reached and no exchange of lobes lowers the criterion enough"
                         : "no further lobe lowers the criterion enough");
  }

  /// Lambert first, then ggx from wide to narrow, then retro: one order for equal sets.
  void finish() {
    std::vector<Lobe>& lobes = present_.lobes.lobes;
    for (std::size_t l = 0; l < lobes.size(); ++l) result_.trials[trial_of_[l]].alpha = lobes[l].alpha;
    std::stable_sort(lobes.begin(), lobes.end(), [](const Lobe& a, const Lobe& b) {
      return a.kind != b.kind ? a.kind < b.kind : a.alpha > b.alpha;
    });
    const double weight = std::accumulate(samples_.weight.begin(), samples_.weight.end(), 0.0);
    result_.cost = 0.5 * present_.mean_loss * weight * samples_.channels;
    result_.required = required_;
    result_.lobes = std::move(present_.lobes);
    if (result_.stop_reason.empty()) result_.stop_reason = "the limit of search rounds is reached";
  }

  const PreparedSamples& samples_;
  const FitOptions& options_;
  ProgressGate& gate_;
  std::size_t screening_ = 0;
  double required_ = 0;
  Fitted present_;
  std::vector<std::size_t> trial_of_;  ///< index into result_.trials of each present lobe
  SearchResult result_;
};

}  // namespace

SearchResult search_lobes(const PreparedSamples& samples, const FitOptions& options, ProgressGate& gate) {
  return Search(samples, options, gate).run();
}

}  // namespace brdf::fit

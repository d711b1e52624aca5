// SPDX-License-Identifier: Apache-2.0
#include "encode/error_search.h"

#include "encode/layers.h"

#include <brdf/error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

namespace brdf::encode {
namespace {

constexpr int coarsest_step = 8, finest_step = 128;  // 2^3 to 2^-12
constexpr double reserve = 1e-4;  // share of the target kept for rounding: batch and single-pair evaluation differ by less
constexpr int calibrations = 4;
constexpr double tight = 0.01;    // a file this close to its target is the smallest of its kind

/// A target as "at most so much", whichever way the metric counts.
class Aim {
 public:
  explicit Aim(const ErrorTarget& t) : metric_(t.metric), decibels_(t.metric == Metric::psnr_env || t.metric == Metric::psnr_lights) {
    limit_ = decibels_ ? -t.value - reserve : t.value * (1 - reserve);
  }
  double cost(const ErrorReport& r) const noexcept { return decibels_ ? -r.get(metric_) : r.get(metric_); }
  double value(double cost) const noexcept { return decibels_ ? -cost : cost; }
  double limit() const noexcept { return limit_; }
  /// Share of the limit that is not used; tenths of a decibel count as a share.
  double slack(double cost) const noexcept { return decibels_ ? (limit_ - cost) / 10 : (limit_ - cost) / std::max(limit_, 1e-300); }
  /// The limit to use with a coarse verification that says `coarse` where the full one says `full`.
  double calibrated(double coarse, double full) const noexcept {
    return decibels_ ? limit_ + (coarse - full) : limit_ * (full > 0 ? coarse / full : 1.0);
  }

 private:
  Metric metric_;
  bool decibels_;
  double limit_;
};

/// Files of one candidate in the order of their size.
class Ladder {
 public:
  Ladder(const Candidate& candidate, const SourceData& source, const Search& search, const Aim& aim, bool in_slices)
      : candidate_(candidate), source_(source), search_(search), aim_(aim), in_slices_(in_slices) {}

  /// The file at a step and price; tables are chosen for the first one and kept.
  Encoded file(int step, double log_price) {
    const double price = std::exp2(log_price);
    Encoded e = candidate_.encode(step, price, 1);
    const int layers = layer_count(e.bytes.size());
    if (layers > 1) e = candidate_.encode(step, price, layers);
    if (in_slices_ && !e.content.residual.empty()) {
      if (!table_) {
        choose_table(e, source_.effort.table_variants, search_.level, search_.verification);
        table_ = e.content.residual.basis;
      }
      e.content.residual.basis = *table_;
      e.bytes = container::pack(e.content);
    }
    return e;
  }
  double cost(const Encoded& e) const { return aim_.cost(search_.verification.score(e.bytes, search_.level)); }

  /// Smallest file that the coarse verification puts at `limit`, below `most` bytes; none when there is none.
  std::optional<Encoded> smallest(double limit, std::uint64_t most) {
    if (most != std::numeric_limits<std::uint64_t>::max()) {  // is there any hope?
      const std::vector<Encoded> fitting = candidate_.encode_to_size(most);
      if (fitting.empty()) return {};
      Encoded e = file(fitting.front().step_code, std::log2(fitting.front().lambda_scale));
      if (cost(e) > limit) return {};
    }
    int low = coarsest_step, high = finest_step;
    if (near_) {  // a limit that has moved by little: its step has, too
      low = std::max(low, *near_ - 4);
      high = std::min(high, *near_ + 4);
    }
    std::optional<Encoded> found;
    while (low < high) {
      const int middle = (low + high) / 2;
      Encoded e = file(middle, 0);
      if (cost(e) <= limit) {
        high = middle;
        found = std::move(e);
      } else {
        low = middle + 1;
      }
    }
    if (!found) {
      Encoded e = file(high, 0);
      if (cost(e) > limit) {
        if (!std::exchange(near_, std::nullopt)) return {};
        return smallest(limit, std::numeric_limits<std::uint64_t>::max());
      }
      found = std::move(e);
    }
    near_ = high;
    for (const int step : {high, std::min(high + 1, finest_step)}) {  // the same step, or a finer one, at a steeper price
      double cheap = 0, dear = step == high ? 1.0 : 2.0;
      for (int i = 0; i < 3; ++i) {
        const double price = (cheap + dear) / 2;
        Encoded e = file(step, price);
        if (cost(e) <= limit) {
          cheap = price;
          if (e.bytes.size() < found->bytes.size()) found = std::move(e);
        } else {
          dear = price;
        }
      }
    }
    return found;
  }

 private:
  const Candidate& candidate_;
  const SourceData& source_;
  const Search& search_;
  const Aim& aim_;
  bool in_slices_;
  std::optional<residual::BasisCodes> table_;
  std::optional<int> near_;  ///< step of the file found last
};

/// All sizes are open: from the recipes of a middling file to those of the largest, and more coefficients where a target asks.
std::vector<Recipe> ways_to_any_size(const SourceData& source, const Search& search) {
  constexpr std::uint64_t middling = 2048, large = 32768;
  std::vector<Recipe> all;
  for (const Recipe& r : recipes(source, search.bases, search.azimuths, middling))
    if (r.slices) all.push_back(r);
  for (const Recipe& r : recipes(source, search.bases, search.azimuths, large)) {
    if (r.slices && r.slices->coefficients == static_cast<int>(residual::max_coefficients)) all.push_back(r);
    if (!r.slices) all.push_back(r);
  }
  return all;
}

}  // namespace

Encoded encode_to_error(const SourceData& source, const Search& search, const ErrorTarget& target, const Verification& full,
                        const std::function<void(double share)>& done) {
  const Aim aim(target);
  double best_cost = std::numeric_limits<double>::max();
  const auto full_cost = [&](const Encoded& e) {
    const double c = aim.cost(full.score(e.bytes, search.level));
    best_cost = std::min(best_cost, c);
    return c;
  };
  Encoded alone = lobes_only(source.frame);
  if (full_cost(alone) <= aim.limit()) return alone;

  std::optional<Encoded> found;
  std::optional<Recipe> winner;
  std::optional<Encoded> finest;  // the best that was seen when nothing meets the target
  double finest_cost = std::numeric_limits<double>::max();
  const auto try_recipe = [&](const Recipe& recipe) {
    const std::optional<Candidate> candidate = make_candidate(source, recipe);
    if (!candidate) return;
    Ladder ladder(*candidate, source, search, aim, recipe.slices.has_value());
    std::optional<Encoded> e = ladder.smallest(aim.limit(), found ? found->bytes.size() - found->bytes.size() / 100 - 1
                                                                  : std::numeric_limits<std::uint64_t>::max());
    if (e) {
      if (!found || e->bytes.size() < found->bytes.size()) {
        found = std::move(e);
        winner = recipe;
      }
    } else if (!found) {
      Encoded last = ladder.file(finest_step, 0);
      const double c = ladder.cost(last);
      if (c < finest_cost) {
        finest_cost = c;
        finest = std::move(last);
        winner = recipe;
      }
    }
  };
  if (search.level != EvalLevel::fast) {
    const std::vector<Recipe> ways = ways_to_any_size(source, search);
    double tried = 0;
    for (const Recipe& recipe : ways) {
      try_recipe(recipe);
      done(++tried / static_cast<double>(ways.size()) * 0.8);
    }
    // near the lossless end the rounding of the ndf is what is left
    if (!found)
      for (Recipe finer : ways)
        if (finer.slices && finer.slices->coefficients == static_cast<int>(residual::max_coefficients)) {
          finer.slices->ndf_step = residual::max_ndf_step;
          try_recipe(finer);
        }
    // more coefficients in half/difference coordinates, for a target that the effort's number does not reach
    for (int more = 2 * source.effort.coefficients; search.exhaustive && !found && more < 2 * Candidate::largest_matrix; more *= 2) {
      for (const Recipe& recipe : ways) {
        if (recipe.slices || recipe.basis.kappa_h != search.bases.front().kappa_h) continue;
        Recipe larger = recipe;
        larger.coefficients = std::min(more, Candidate::largest_matrix);
        try_recipe(larger);
        break;
      }
      done(0.8);
    }
  }

  if (found || finest) {
    // the coarse verification is off by a percent or so: say what it should ask for
    const std::optional<Candidate> candidate = make_candidate(source, *winner);
    Ladder ladder(*candidate, source, search, aim, winner->slices.has_value());
    std::optional<Encoded> met;
    std::optional<Encoded> now = found ? std::move(found) : std::move(finest);
    for (int i = 0; now && i < calibrations; ++i) {
      const double c = full_cost(*now);
      const bool ok = c <= aim.limit();
      const double limit = aim.calibrated(ladder.cost(*now), c);
      const bool close = ok && aim.slack(c) < tight;
      if (ok && (!met || now->bytes.size() < met->bytes.size())) met = std::move(now);
      if (close || (met && !ok && i > 1)) break;
      now = ladder.smallest(limit - (aim.value(1) > 0 ? 0.001 * limit : 0.005), std::numeric_limits<std::uint64_t>::max());
      done(0.8 + 0.2 * (i + 1) / calibrations);
    }
    if (met) return std::move(*met);
  }
  char text[160];
  std::snprintf(text, sizeof text, "compress: %s of %.6g cannot be reached at level %s, the best reachable value is %.6g",
                to_string(target.metric), target.value, to_string(search.level), aim.value(best_cost));
  throw Error(ErrorCode::target_not_met, text);
}

}  // namespace brdf::encode

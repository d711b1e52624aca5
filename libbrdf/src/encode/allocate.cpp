// SPDX-License-Identifier: Apache-2.0
#include <brdf/error.h>
#include <brdf/trade.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace brdf {
namespace {

/// Lower convex hull by ascending cost, from the cheapest to the best alternative; indices into `alternatives`.
std::vector<std::size_t> lower_hull(const std::vector<Alternative>& alternatives) {
  std::vector<std::size_t> order(alternatives.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Alternative &x = alternatives[a], &y = alternatives[b];
    return x.cost < y.cost || (x.cost == y.cost && x.error < y.error);
  });
  std::vector<std::size_t> hull;
  for (const std::size_t i : order) {
    const Alternative& p = alternatives[i];
    if (!hull.empty() && p.error >= alternatives[hull.back()].error) continue;  // costs more and is no better
    const auto above = [&] {  // the last point, seen from the one before it and p
      const Alternative &a = alternatives[hull[hull.size() - 2]], &b = alternatives[hull.back()];
      return (a.error - b.error) * (p.cost - a.cost) <= (a.error - p.error) * (b.cost - a.cost);
    };
    while (hull.size() > 1 && above()) hull.pop_back();
    hull.push_back(i);
  }
  return hull;
}

struct Segment {
  std::size_t item, to;
  double cost, slope;
};

/// An alternative of an item, seen from its present choice.
struct Move {
  std::size_t item = 0, to = 0;
  double cost = 0, gain = 0;
};

/// Takes the move, or the two of different items, that lower the error most among those that the budget allows; false when
/// none does. Pairs are tried where there are few enough of them.
bool improve(std::span<const std::vector<Alternative>> items, std::span<const double> weights, double budget, Allocation& now) {
  constexpr std::size_t most_paired = 2000;
  constexpr double least_gain = 1e-12;  // of the error: what rounding alone may make of nothing
  std::vector<Move> moves;
  double error = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Alternative& here = items[i][now.choice[i]];
    error += weights[i] * here.error;
    for (std::size_t k = 0; k < items[i].size(); ++k)
      if (k != now.choice[i]) moves.push_back({i, k, items[i][k].cost - here.cost, weights[i] * (here.error - items[i][k].error)});
  }
  const double room = budget - now.cost;
  double best = least_gain * error;
  const Move *first = nullptr, *second = nullptr;
  for (const Move& a : moves) {
    if (a.cost <= room && a.gain > best) {
      best = a.gain;
      first = &a;
      second = nullptr;
    }
    if (a.gain <= 0 || moves.size() > most_paired) continue;  // of a pair one gains
    for (const Move& b : moves)
      if (b.item != a.item && a.cost + b.cost <= room && a.gain + b.gain > best) {
        best = a.gain + b.gain;
        first = &a;
        second = &b;
      }
  }
  if (first == nullptr) return false;
  for (const Move* m : {first, second}) {
    if (m == nullptr) continue;
    now.choice[m->item] = m->to;
    now.cost += m->cost;
  }
  return true;
}

void require_valid(std::span<const std::vector<Alternative>> items, std::span<const double> weights, double budget) {
  const auto refuse = [](const std::string& sentence) { throw Error(ErrorCode::invalid_argument, "allocate: " + sentence); };
  const auto number = [](double v) { return std::isfinite(v) && v >= 0; };
  if (items.size() != weights.size())
    refuse(std::to_string(weights.size()) + " weights for " + std::to_string(items.size()) + " items");
  if (std::isnan(budget)) refuse("the budget is no number");
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!number(weights[i])) refuse("the weight of item " + std::to_string(i) + " is negative or no number");
    if (items[i].empty()) refuse("item " + std::to_string(i) + " has no alternative");
    for (const Alternative& a : items[i])
      if (!number(a.cost) || !number(a.error)) refuse("an alternative of item " + std::to_string(i) + " is negative or no number");
  }
}

}  // namespace

Allocation allocate(std::span<const std::vector<Alternative>> items, std::span<const double> weights, double budget) {
  require_valid(items, weights, budget);
  Allocation found;
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::vector<std::size_t> hull = lower_hull(items[i]);
    found.choice.push_back(hull.front());
    found.cost += items[i][hull.front()].cost;
    for (std::size_t k = 1; k < hull.size(); ++k) {
      const Alternative &from = items[i][hull[k - 1]], &to = items[i][hull[k]];
      const double gain = weights[i] * (from.error - to.error);
      if (gain > 0) segments.push_back({i, hull[k], to.cost - from.cost, gain / (to.cost - from.cost)});
    }
  }
  if (found.cost > budget) {
    char text[120];
    std::snprintf(text, sizeof text, "allocate: the cheapest choice costs %.6g, the budget is %.6g", found.cost, budget);
    throw Error(ErrorCode::target_not_met, text);
  }
  // slopes fall along each hull, so the order of one item's segments stays
  std::stable_sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.slope > b.slope; });
  for (const Segment& s : segments) {
    if (found.cost + s.cost > budget) {  // what follows has a lower slope: from here on the rest of the budget is filled
      found.price = s.slope;
      break;
    }
    found.choice[s.item] = s.to;
    found.cost += s.cost;
  }
  while (improve(items, weights, budget, found)) {
  }
  found.cost = found.error = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    found.cost += items[i][found.choice[i]].cost;
    found.error += weights[i] * items[i][found.choice[i]].error;
  }
  return found;
}

}  // namespace brdf

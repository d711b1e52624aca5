// SPDX-License-Identifier: Apache-2.0
#include "support/expect_error.h"

#include <brdf/trade.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace brdf {
namespace {

using Items = std::vector<std::vector<Alternative>>;

struct Best {
  double error = std::numeric_limits<double>::infinity(), cost = 0;
};

/// The smallest error of all choices that the budget allows.
Best by_trying_all(const Items& items, const std::vector<double>& weights, double budget) {
  Best best;
  std::vector<std::size_t> choice(items.size(), 0);
  for (;;) {
    double cost = 0, error = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      cost += items[i][choice[i]].cost;
      error += weights[i] * items[i][choice[i]].error;
    }
    if (cost <= budget && error < best.error) best = {error, cost};
    std::size_t i = 0;
    while (i < items.size() && ++choice[i] == items[i].size()) choice[i++] = 0;
    if (i == items.size()) return best;
  }
}

struct Case {
  Items items;
  std::vector<double> weights;
};

Case random_case(std::mt19937& engine) {
  const auto number = [&](int most) { return static_cast<double>(engine() % static_cast<unsigned>(most)); };
  Case c;
  c.items.resize(1 + engine() % 4);
  for (auto& item : c.items) {
    c.weights.push_back(number(5));
    item.resize(1 + engine() % 5);
    for (Alternative& a : item) a = {number(40), number(100)};
  }
  return c;
}

double cheapest(const Items& items) {
  double sum = 0;
  for (const auto& item : items)
    sum += std::min_element(item.begin(), item.end(), [](const Alternative& a, const Alternative& b) { return a.cost < b.cost; })->cost;
  return sum;
}

TEST(Allocate, NeverExceedsTheBudgetAndIsNearTheBestChoice) {
  std::mt19937 engine(5);
  int optimal = 0;
  constexpr int cases = 400;
  for (int n = 0; n < cases; ++n) {
    const Case c = random_case(engine);
    const double budget = cheapest(c.items) + static_cast<double>(engine() % 60);
    const Allocation a = allocate(c.items, c.weights, budget);
    const Best best = by_trying_all(c.items, c.weights, budget);
    double cost = 0, error = 0;
    for (std::size_t i = 0; i < c.items.size(); ++i) {
      ASSERT_LT(a.choice[i], c.items[i].size());
      cost += c.items[i][a.choice[i]].cost;
      error += c.weights[i] * c.items[i][a.choice[i]].error;
    }
    EXPECT_LE(a.cost, budget);
    EXPECT_DOUBLE_EQ(a.cost, cost);
    EXPECT_DOUBLE_EQ(a.error, error);
    EXPECT_GE(a.error, best.error - 1e-9);
    // duality: what was not spent, at the price at which the budget ended, bounds what is lost
    EXPECT_LE(a.error, best.error + a.price * (budget - a.cost) + a.price * 40 + 1e-9);
    optimal += a.error <= best.error + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(optimal, cases * 19 / 20);
}

// Budgets that whole segments of the hulls use up are met by the best of all choices.
TEST(Allocate, IsExactOnTheHull) {
  std::mt19937 engine(7);
  int compared = 0;
  for (int n = 0; n < 200; ++n) {
    const Case c = random_case(engine);
    for (double budget = cheapest(c.items); budget < 120; budget += 3) {
      const Allocation a = allocate(c.items, c.weights, budget);
      if (a.price > 0) continue;  // the rest of the budget was filled step by step
      EXPECT_NEAR(a.error, by_trying_all(c.items, c.weights, budget).error, 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
  const Items two = {{{0, 16}, {1, 8}, {3, 4}, {9, 3}}, {{0, 10}, {2, 4}, {5, 1}}};
  const std::vector<double> weights = {1, 2};
  // slopes: 8, 2, 1/6 and (weight 2) 6, 2
  EXPECT_EQ(allocate(two, weights, 0).choice, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(allocate(two, weights, 1).choice, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(allocate(two, weights, 3).choice, (std::vector<std::size_t>{1, 1}));
  EXPECT_EQ(allocate(two, weights, 8).choice, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(allocate(two, weights, 100).choice, (std::vector<std::size_t>{3, 2}));
  for (const double budget : {0.0, 1.0, 3.0, 5.0, 8.0, 14.0}) EXPECT_NEAR(allocate(two, weights, budget).error, by_trying_all(two, weights, budget).error, 1e-12) << budget;
}

TEST(Allocate, PointsOffTheHullFillWhatIsLeft) {
  const Items one = {{{0, 10}, {5, 6}, {10, 0}}};  // (5, 6) lies above the line from (0, 10) to (10, 0)
  const std::vector<double> weight = {1};
  EXPECT_EQ(allocate(one, weight, 10).choice[0], 2U);
  EXPECT_EQ(allocate(one, weight, 9).choice[0], 1U);
  EXPECT_GT(allocate(one, weight, 9).price, 0);
}

TEST(Allocate, RefusesWhatHasNoAnswer) {
  const std::vector<double> one = {1};
  const auto refused = [&](ErrorCode code, const Items& items, std::span<const double> weights, double budget, const char* word) {
    test::expect_error(code, {word}, [&] { allocate(items, weights, budget); });
  };
  refused(ErrorCode::target_not_met, {{{4, 1}}}, one, 3, "cheapest choice costs 4");
  refused(ErrorCode::invalid_argument, {{}}, one, 3, "no alternative");
  refused(ErrorCode::invalid_argument, {{{1, 1}}}, {}, 3, "0 weights for 1 items");
  refused(ErrorCode::invalid_argument, {{{1, std::nan("")}}}, one, 3, "no number");
  refused(ErrorCode::invalid_argument, {{{-1, 1}}}, one, 3, "negative");
  refused(ErrorCode::invalid_argument, {{{1, 1}}}, one, std::nan(""), "budget");
  EXPECT_TRUE(allocate({}, {}, 0).choice.empty());
}

}  // namespace
}  // namespace brdf

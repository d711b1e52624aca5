// SPDX-License-Identifier: Apache-2.0
// The test statistic itself: tabulated quantiles (Abramowitz and Stegun 1964, table 26.8) and known histograms.
#include "support/chi_squared.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace brdf::test;

TEST(ChiSquared, TailMatchesTheTables) {
  EXPECT_NEAR(chi_squared_tail(3.84146, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(18.3070, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi_squared_tail(135.807, 100), 0.01, 1e-6);
  EXPECT_NEAR(chi_squared_tail(70.0649, 100), 0.99, 1e-6);
  EXPECT_NEAR(chi_squared_tail(4, 2), std::exp(-2.0), 1e-14);
}

TEST(ChiSquared, AcceptsFairAndRefusesLoadedDice) {
  std::mt19937 random(5);
  std::vector<double> fair(60, 0.0), loaded(60, 0.0);
  const std::vector<double> expected(60, 1000.0);
  for (int i = 0; i < 60000; ++i) {
    ++fair[random() % 60];
    ++loaded[random() % 100 < 3 ? 7 : random() % 60];
  }
  EXPECT_GT(chi_squared_p_value(fair, expected), 1e-3);
  EXPECT_LT(chi_squared_p_value(loaded, expected), 1e-6);
}

TEST(ChiSquared, ObservationsWhereNothingIsExpectedAreRefused) {
  EXPECT_EQ(chi_squared_p_value(std::array{1.0, 99.0}, std::array{0.0, 100.0}), 0);
}

TEST(ChiSquared, SidakThresholdOfOneTestIsItsLevel) {
  EXPECT_NEAR(sidak_threshold(0.01, 1), 0.01, 1e-15);
  EXPECT_NEAR(sidak_threshold(0.01, 10), 0.01 / 10, 1e-5);
}

}  // namespace

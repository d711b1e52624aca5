// SPDX-License-Identifier: Apache-2.0
// The warp of heights: onto [0, 1], concave, its slope and its inverse, and where lobes get their cells.
#include "sample/height_warp.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using brdf::sample::HeightWarp;

const double roughness[] = {1e-5, 1e-4, 0.0026, 0.03, 0.3, 0.9, 1};

TEST(SampleWarp, MapsTheIntervalOntoItselfAndIsConcave) {
  for (const double alpha : roughness) {
    const HeightWarp warp(alpha);
    EXPECT_EQ(warp(0.0).t, 0);
    EXPECT_NEAR(warp(1.0).t, 1, 1e-7) << alpha;
    double y = 0, slope = warp(0.0).slope;
    for (int i = 1; i <= 400; ++i) {
      const double next = std::pow(10.0, -13 + 13.0 * i / 400);
      const auto at = warp(next);
      ASSERT_GT(at.t, warp(y).t) << alpha << " at " << next;
      ASSERT_LE(at.slope, slope) << alpha << " at " << next;
      y = next;
      slope = at.slope;
    }
  }
}

TEST(SampleWarp, SlopeIsTheDerivative) {
  for (const double alpha : roughness) {
    const HeightWarp warp(alpha);
    for (const double y : {1e-9, 1e-5, 0.003, 0.1, 0.6, 0.99}) {
      const double step = 1e-5 * (y + 0.01 * alpha * alpha);
      const double difference = (warp(y + step).t - warp(y - step).t) / (2 * step);
      EXPECT_NEAR(warp(y).slope, difference, 1e-5 * difference) << alpha << " at " << y;
    }
  }
}

TEST(SampleWarp, InverseReturnsTheHeight) {
  for (const double alpha : roughness) {
    const HeightWarp warp(alpha);
    for (int i = 0; i <= 1000; ++i) {
      const double t = i / 1000.0, y = warp.inverse(t);
      ASSERT_NEAR(warp(y).t, t, 1e-7) << alpha;
      ASSERT_TRUE(y >= 0 && y <= 1) << alpha;
    }
  }
}

// The integral of D at normal incidence, y / (y + k) for k = alpha^2 / 2, is what the narrowest lobe holds below a height.
TEST(SampleWarp, TheNarrowestLobeGetsAThirdOfTheCells) {
  for (const double alpha : {0.0026, 0.03, 0.2}) {
    const HeightWarp warp(alpha);
    const double k = 0.5 * alpha * alpha, almost_all = 9 * k;
    EXPECT_GT(warp(almost_all).t, 0.33) << alpha;
    EXPECT_LT(warp(0.5).t, 0.95) << alpha << ": what is diffuse keeps its cells";
  }
}

}  // namespace

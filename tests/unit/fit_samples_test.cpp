// SPDX-License-Identifier: Apache-2.0
// The direction pairs that carry the loss.
#include "fit/collect_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace brdf::fit {
namespace {

constexpr double pi = 3.14159265358979323846;

bool one_everywhere(const Vec3d&, const Vec3d&, std::span<double> f) {
  std::fill(f.begin(), f.end(), 1.0);
  return true;
}

TEST(FitSamples, AreUnitVectorsUpTo85Degrees) {
  const SampleSet set = collect_samples(one_everywhere, 3, 5000);
  ASSERT_EQ(set.size(), 5000U);
  ASSERT_EQ(set.values.size(), 15000U);
  double steepest = 1;
  for (std::size_t s = 0; s < set.size(); ++s) {
    for (const Vec3d& w : {set.wi[s], set.wo[s]}) {
      EXPECT_NEAR(w.x * w.x + w.y * w.y + w.z * w.z, 1, 1e-12);
      steepest = std::min(steepest, w.z);
    }
    EXPECT_GT(set.weight[s], 0);
    EXPECT_TRUE(std::isfinite(set.weight[s]));
  }
  EXPECT_GE(steepest, std::cos(85 * pi / 180));
  EXPECT_LT(steepest, std::cos(83 * pi / 180));
}

TEST(FitSamples, SquaredWeightsUndoTheDensity) {
  // weight^2 = cos_i cos_o / density: means under it are cosine-weighted means over both hemispheres, known in closed
  // form. A wrong Jacobian or mixture density shows here.
  const SampleSet set = collect_samples(one_everywhere, 1, 200000);
  double w = 0, ci = 0, co = 0, both = 0, between = 0;
  for (std::size_t s = 0; s < set.size(); ++s) {
    const double k = set.weight[s] * set.weight[s];
    const Vec3d &a = set.wi[s], &b = set.wo[s];
    w += k, ci += k * a.z, co += k * b.z, both += k * a.z * b.z, between += k * (a.x * b.x + a.y * b.y + a.z * b.z);
  }
  const double c = std::cos(85 * pi / 180), mean = 2.0 / 3 * (1 - c * c * c) / (1 - c * c);
  EXPECT_NEAR(ci / w, mean, 0.005);
  EXPECT_NEAR(co / w, mean, 0.005);
  EXPECT_NEAR(both / w, mean * mean, 0.005);
  EXPECT_NEAR(between / w, mean * mean, 0.005);  // the horizontal parts cancel
}

TEST(FitSamples, CoverMirrorAndRetroPeaks) {
  const SampleSet set = collect_samples(one_everywhere, 1, 6000);
  int mirror = 0, retro = 0;
  for (std::size_t s = 0; s < set.size(); ++s) {
    const Vec3d &a = set.wi[s], &b = set.wo[s];
    mirror += std::hypot(a.x + b.x, a.y + b.y) < 0.02 ? 1 : 0;
    retro += std::hypot(a.x - b.x, a.y - b.y) < 0.02 ? 1 : 0;
  }
  EXPECT_GT(mirror, 300);
  EXPECT_GT(retro, 60);
}

TEST(FitSamples, LeaveOutWhatWasNotMeasured) {
  const auto partly = [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    f[0] = wi.x > 0 && wi.y > 0 ? std::numeric_limits<double>::quiet_NaN() : wi.y > 0 ? -2.0 : 3.0;
    return wo.y > 0;
  };
  const SampleSet set = collect_samples(partly, 1, 2000);
  EXPECT_EQ(set.size(), 2000U);
  for (std::size_t s = 0; s < set.size(); ++s) {
    EXPECT_GT(set.wo[s].y, 0);
    EXPECT_FALSE(set.wi[s].x > 0 && set.wi[s].y > 0);
    EXPECT_EQ(set.values[s], set.wi[s].y > 0 ? 0 : 3);  // negative noise is clipped
  }
  const auto never = [](const Vec3d&, const Vec3d&, std::span<double>) { return false; };
  EXPECT_EQ(collect_samples(never, 1, 500).size(), 0U);
}

TEST(FitSamples, ArePrefixesOfEachOther) {
  const SampleSet few = collect_samples(one_everywhere, 1, 100), many = collect_samples(one_everywhere, 1, 1000);
  ASSERT_EQ(few.size(), 100U);
  for (std::size_t s = 0; s < few.size(); ++s) {
    EXPECT_EQ(few.wi[s], many.wi[s]);
    EXPECT_EQ(few.weight[s], many.weight[s]);
  }
}

}  // namespace
}  // namespace brdf::fit

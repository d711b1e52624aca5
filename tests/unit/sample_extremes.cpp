// SPDX-License-Identifier: Apache-2.0
// Sampling at the corners of the unit cube, at the horizon, and of the narrowest lobes.
#include "support/direction_batch.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace {

using namespace brdf;
using test::DirectionBatch;

const float largest = std::nextafter(1.0f, 0.0f);

/// Material of one lobe.
Material narrow(double alpha, bool retro) {
  return test::material_of({3, {test::ggx_lobe(3, alpha, 0.9, 1, retro)}});
}

TEST(SampleExtremes, CornersOfTheUnitCubeAreFinite) {
  DirectionBatch wo, u;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (float cosine : {1.0f, 0.999999f, 0.7f, 0.01f, 1e-4f, 1e-7f, 1e-20f, 0.0f, -0.5f})
    for (float a : {0.0f, 1e-30f, 0.5f, largest, 1.0f, nan})
      for (float b : {0.0f, 1e-30f, 0.25f, 0.5f, largest, 1.0f})
        for (float c : {0.0f, 1e-30f, 0.125f, 0.5f, 0.75f, largest, 1.0f, nan}) {
          wo.push({std::sqrt(std::max(1 - cosine * cosine, 0.0f)), 0, cosine});
          u.push({a, b, c});
        }
  const std::size_t n = wo.size();
  for (const Material& m : {test::material_of(test::usual_lobes()), narrow(1e-5, false), narrow(1e-5, true), narrow(1, false),
                            test::material_of(test::usual_lobes(), test::synthetic_grid({})), test::material_of({3, {}})}) {
    const auto check = [&](const Vec3f& wi, float pdf, float weight, std::size_t i) {
      ASSERT_TRUE(std::isfinite(pdf) && std::isfinite(weight) && pdf >= 0 && weight >= 0) << i;
      if (pdf > 0) {
        ASSERT_GT(wi.z, 0) << i;
        ASSERT_NEAR(std::sqrt(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z), 1, 2e-6) << i;
      } else {
        ASSERT_EQ(weight, 0);
        ASSERT_EQ(wi, Vec3f(0, 0, 0));
      }
    };
    std::array<float, 3> row{};
    for (std::size_t i = 0; i < n; ++i) {
      const Sample s = m.sample(wo[i], u[i], row);
      check(s.wi, s.pdf, row[1], i);
      ASSERT_EQ(s.flags, s.pdf > 0 ? sample_reflection : sample_none);
      ASSERT_EQ(s.eta, 1);
      ASSERT_TRUE(wo.z[i] > 0 || s.pdf == 0) << i;
    }
    test::on_every_target([&] {
      DirectionBatch wi(n);
      std::vector<float> pdf(n), weight(3 * n);
      m.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n});
      for (std::size_t i = 0; i < n; ++i) check(wi[i], pdf[i], weight[n + i], i);
    });
  }
}

TEST(SampleExtremes, AMaterialOfNothingSamplesTheCosineWithWeightZero) {
  const Material m = test::material_of({3, {test::lambert_lobe(3, 0), test::ggx_lobe(3, 0.2, 0, 0)}});
  const DirectionBatch u = test::random_numbers(1000, 3);
  const Vec3f wo = test::direction_at(0.6, 1);
  int found = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    std::array<float, 3> weight{1, 1, 1};
    const Sample s = m.sample(wo, u[i], weight);
    found += s.pdf > 0;
    EXPECT_EQ(weight, (std::array<float, 3>{0, 0, 0}));
  }
  EXPECT_GT(found, 900);
}

/// At normal incidence f cos_i of a narrow GGX lobe is as the visible normals: P(tan^2 theta_h < t alpha^2) = t / (1 + t).
/// Weights over the samples must say the same, whatever the table makes of the lobe. Kolmogorov-Smirnov.
TEST(SampleExtremes, NarrowLobesFollowTheirDistributionDownToTheSmallestAlpha) {
  const std::size_t n = 20000;
  const DirectionBatch u = test::random_numbers(n, 9);
  for (double alpha : {1e-5, 1e-4, 1e-3, 1e-2, 0.1}) {
    for (bool retro : {false, true}) {
      const Material m = narrow(alpha, retro);
      std::vector<std::pair<double, double>> share;  // and weight
      double peak = 0, total = 0;
      for (std::size_t i = 0; i < n; ++i) {
        std::array<float, 3> weight{};
        const Vec3f from_lobe{0.5f * u.x[i], u.y[i], u.z[i]};  // the GGX component comes first
        const Sample s = m.sample({0, 0, 1}, from_lobe, weight);
        ASSERT_TRUE(std::isfinite(s.pdf) && std::isfinite(weight[0]));
        if (!(s.pdf > 0)) continue;
        peak = std::max(peak, static_cast<double>(s.pdf));
        const double tan_h = std::hypot(s.wi.x, s.wi.y) / (1 + static_cast<double>(s.wi.z)), t = tan_h * tan_h / (alpha * alpha);
        share.emplace_back(t / (1 + t), weight[0]);
        total += static_cast<double>(weight[0]);
        // 32 cells from 0 to 1 are few for a lobe of 1e-10
        ASSERT_TRUE(alpha > 1e-3 || share.back().first > 0.99 || (weight[0] > 0.25f && weight[0] < 1.5f)) << weight[0];
      }
      ASSERT_GT(share.size(), n * 95 / 100);
      EXPECT_GT(peak, (alpha < 5e-4 ? 0.8 : 0.9) / (4 * 3.1416 * alpha * alpha));
      std::sort(share.begin(), share.end());
      double distance = 0, upto = 0;
      for (const auto& [place, weight] : share) {
        upto += weight / total;
        distance = std::max(distance, std::fabs(place - upto));
      }
      EXPECT_LT(distance, 1.95 / std::sqrt(static_cast<double>(n)) + (alpha >= 0.1 ? 0.02 : 0.002)) << alpha << retro;
    }
  }
}

TEST(SampleExtremes, ARetroLobeSendsLightBack) {
  const Vec3f wo = test::direction_at(0.5, 2);
  std::array<float, 3> weight{};
  const Sample s = narrow(1e-4, true).sample(wo, {0.2f, 0.3f, 0.4f}, weight);
  EXPECT_NEAR(s.wi.x, wo.x, 2e-3);
  EXPECT_NEAR(s.wi.y, wo.y, 2e-3);
  const Sample mirrored = narrow(1e-4, false).sample(wo, {0.2f, 0.3f, 0.4f}, weight);
  EXPECT_NEAR(mirrored.wi.x, -wo.x, 2e-3);
  EXPECT_NEAR(mirrored.wi.y, -wo.y, 2e-3);
}

TEST(SampleExtremes, AlbedoOfKnownMaterials) {
  std::array<float, 3> a{};
  test::material_of({3, {test::lambert_lobe(3, 0.5)}}).albedo(test::direction_at(0.3, 1), a);
  EXPECT_NEAR(a[0], 0.5, 5e-4);
  narrow(1e-4, false).albedo(test::direction_at(0.9, 1), a);  // a mirror: Schlick at 0.9
  EXPECT_NEAR(a[0], 0.9 + 0.1 * 1e-5, 1e-3);
  test::material_of(test::usual_lobes()).albedo({1, 0, 0}, a);
  EXPECT_EQ(a[0], 0);
}

}  // namespace

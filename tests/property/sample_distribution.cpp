// SPDX-License-Identifier: Apache-2.0
// Does sample() draw what pdf() says, and do its weights integrate f cos? At wo from 0 to 89.9 degrees.
#include "support/chi_squared.h"
#include "support/sampling_checks.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {

using namespace brdf;
using test::DirectionBatch;

struct Case {
  std::string name;
  Material material;
};

std::vector<Case> cases() {
  using namespace brdf::test;
  return {{"usual", material_of(usual_lobes())},
          {"one lobe", material_of({3, {ggx_lobe(3, 0.1, 0.8)}})},
          {"rough and retro", material_of({3, {ggx_lobe(3, 0.9, 0.5), ggx_lobe(3, 0.15, 0.4, 1, true)}})},
          {"narrow", material_of({3, {lambert_lobe(3, 0.1), ggx_lobe(3, 0.01, 0.5)}})},
          {"diffuse", material_of({3, {lambert_lobe(3, 0.8)}})},
          {"grid", material_of(usual_lobes(), synthetic_grid({}))},
          {"31 channels", material_of(usual_lobes(31), synthetic_grid({31, 12, 10, 31, false}))},
          {"nothing", material_of({3, {}})}};
}

TEST(SampleDistribution, HistogramsFollowThePdfAndWeightsIntegrateTheMaterial) {
  const std::vector<Case> all = cases();
  const std::vector<Vec3f> directions = test::sampling_views();
  const double threshold = test::sidak_threshold(0.01, static_cast<int>(all.size() * directions.size()));
  for (const Case& c : all)
    for (const Vec3f& wo : directions) {
      SCOPED_TRACE(c.name + " at cos " + std::to_string(wo.z));
      test::expect_sampling(c.material, wo, 100000, threshold);
    }
}

/// How far the density is from its neighbours', relatively: where both directions graze, the azimuth of the half vector
/// loses digits with the sum of their heights, and the horizon of the map changes over as small a range.
float conditioning(const Material& material, const Vec3f& wi, const Vec3f& wo) {
  constexpr float rounding_of_coordinates = 4 * 6e-8f;
  const float here = material.pdf(wi, wo);
  float largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const float step : {-rounding_of_coordinates, rounding_of_coordinates}) {
      Vec3f moved = wi;
      moved[axis] += step;
      largest = std::max(largest, std::fabs(material.pdf(moved, wo) - here));
    }
  return here > 0 ? largest / here : 0.0f;
}

TEST(SampleDistribution, EveryTargetDrawsTheSameDirections) {
  const auto close = [](float a, float b, float bound) { return std::fabs(a - b) <= bound; };
  for (const Case& c : cases()) {
    if (c.material.channels() != 3) continue;
    SCOPED_TRACE(c.name);
    const std::size_t n = 3001;
    const DirectionBatch u = test::random_numbers(n, 5), wo = test::random_directions(n, 6);
    test::on_every_target([&] {
      DirectionBatch wi(n);
      std::vector<float> pdf(n), weight(3 * n), single(3), value(3), again(n), f(3 * n);
      c.material.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n});
      c.material.eval_pdf(wi.span(), wo.span(), {f.data(), n}, again.data());
      std::size_t other = 0;  // u.x within rounding of the border between two components may fall either way
      for (std::size_t i = 0; i < n; ++i) {
        const Sample s = c.material.sample(wo[i], u[i], single);
        other += !(close(s.wi.x, wi.x[i], 2e-5f) && close(s.wi.y, wi.y[i], 2e-5f) && close(s.wi.z, wi.z[i], 2e-5f));
        for (std::size_t k = 0; k < 3; ++k) {
          const float expected = pdf[i] > 0 ? f[k * n + i] * wi.z[i] / pdf[i] : 0.0f;
          ASSERT_NEAR(weight[k * n + i], expected, 1e-6f * expected);
        }
        // the density at the point drawn, and at the direction that it is rounded to
        const float rounding = 1e-4f + 1e-6f / wi.z[i] + conditioning(c.material, wi[i], wo[i]);
        ASSERT_NEAR(pdf[i], again[i], rounding * pdf[i]) << wo.z[i] << ' ' << wi.z[i];
        ASSERT_EQ(s.flags, sample_reflection);
        ASSERT_NEAR(s.pdf, c.material.eval_pdf(s.wi, wo[i], value), rounding * s.pdf);
        for (std::size_t k = 0; k < 3; ++k) {
          const float expected = s.pdf > 0 ? value[k] * s.wi.z / s.pdf : 0.0f;
          ASSERT_NEAR(single[k], expected, 1e-6f * expected);
        }
      }
      EXPECT_LE(other, n / 500);
    });
  }
}

TEST(SampleDistribution, WeightsAreAlmostConstant) {
  const struct {
    double cosine, deviation;
  } limits[] = {{0.95, 0.05}, {0.6, 0.08}, {0.2, 0.15}};
  for (const auto& [cosine, deviation] : limits) {
    double sum = 0;
    const std::vector<Case> all = cases();
    for (const Case& c : all) {
      if (c.name == "nothing") continue;
      SCOPED_TRACE(c.name);
      const test::WeightSpread q = test::weight_spread(c.material, test::direction_at(cosine, 1));
      EXPECT_LT(q.largest, 4);
      EXPECT_LT(q.deviation, 3 * deviation);
      sum += q.deviation;
    }
    EXPECT_LT(sum / static_cast<double>(all.size() - 1), deviation) << cosine;
  }
}

TEST(SampleDistribution, WeightsOfANoisyGridStayBounded) {
  // the ratio rises by e from one node of the grid to the next, and the table has fewer nodes
  const Material m = test::material_of(test::usual_lobes(), test::synthetic_grid({}, 1.0));
  for (const Vec3f& wo : test::sampling_views()) EXPECT_LT(test::weight_spread(m, wo).largest, 20) << wo.z;
}

TEST(SampleDistribution, WithoutTablesDirectionsAreCosineDistributed) {
  const Material m = test::material_of(test::usual_lobes()).prepare(EvalLevel::fast, false);
  EXPECT_FALSE(m.sampling());
  EXPECT_EQ(m.sampling_bytes(), 0u);
  EXPECT_TRUE(m.prepare(EvalLevel::fast, true).sampling());
  EXPECT_GT(m.prepare(EvalLevel::fast, true).sampling_bytes(), 100000u);
  for (const Vec3f& wo : test::sampling_views()) {
    const test::Draws d = test::draw(m, wo, 1000, 4);
    for (std::size_t i = 0; i < d.pdf.size(); ++i) {
      ASSERT_NEAR(d.pdf[i], d.wi.z[i] / 3.14159265f, 1e-6f);
      ASSERT_EQ(d.pdf[i], m.pdf(d.wi[i], wo));
    }
  }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// Does sample() draw what pdf() says, and do its weights integrate f cos? At wo from 0 to 89.9 degrees.
#include "support/chi_squared.h"
#include "support/map_quadrature.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
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

std::vector<Vec3f> views() {
  std::vector<Vec3f> w;
  for (double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9})
    w.push_back(test::direction_at(std::cos(degrees * 3.14159265358979 / 180), 0.7 + degrees));
  return w;
}

struct Draws {
  DirectionBatch wi;
  std::vector<float> pdf, weight;  ///< weight of channel 0
};

Draws draw(const Material& m, const Vec3f& wo, std::size_t n, std::uint32_t seed) {
  const DirectionBatch u = test::random_numbers(n, seed);
  DirectionBatch view(n);
  for (std::size_t i = 0; i < n; ++i) view.x[i] = wo.x, view.y[i] = wo.y, view.z[i] = wo.z;
  Draws d{DirectionBatch(n), std::vector<float>(n), std::vector<float>(n * static_cast<std::size_t>(m.channels()))};
  m.sample(view.span(), u.span(), d.wi.writable(), d.pdf.data(), {d.weight.data(), n});
  d.weight.resize(n);
  return d;
}

void check_view(const Case& c, const Vec3f& wo, double p_threshold) {
  const Material& m = c.material;
  const std::size_t n = 100000;
  const Draws d = draw(m, wo, n, 77);
  const test::HemisphereGrid grid;
  const test::CellIntegrals integrals = test::integrate(m, wo, grid, c.name == "rough and retro");
  std::vector<double> observed(grid.cells(), 0.0), expected = integrals.pdf;
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = static_cast<double>(d.weight[i]);
    sum += w;
    square += w * w;
    ASSERT_GT(d.pdf[i], 0);
    ASSERT_GT(d.wi.z[i], 0);
    ++observed[grid.cell_of(d.wi[i])];
  }
  const double count = static_cast<double>(n), total = std::accumulate(expected.begin(), expected.end(), 0.0);
  EXPECT_NEAR(total, 1, 1e-3);
  for (double& e : expected) e *= count / total;
  EXPECT_GT(test::chi_squared_p_value(observed, expected), p_threshold);

  const double mean = sum / count, error = std::sqrt(std::max(square / count - mean * mean, 0.0) / count);
  const double integral = std::accumulate(integrals.f_cos.begin(), integrals.f_cos.end(), 0.0);
  EXPECT_NEAR(mean, integral, 4 * error + 1e-4 * integral);
  std::vector<float> albedo(static_cast<std::size_t>(m.channels()));
  m.albedo(wo, albedo);
  EXPECT_NEAR(static_cast<double>(albedo[0]), integral, (wo.z > 0.1f ? 2e-3 : 1e-2) * integral);
}

TEST(SampleDistribution, HistogramsFollowThePdfAndWeightsIntegrateTheMaterial) {
  const std::vector<Case> all = cases();
  const std::vector<Vec3f> directions = views();
  const double threshold = test::sidak_threshold(0.01, static_cast<int>(all.size() * directions.size()));
  for (const Case& c : all)
    for (const Vec3f& wo : directions) {
      SCOPED_TRACE(c.name + " at cos " + std::to_string(wo.z));
      check_view(c, wo, threshold);
    }
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
        // the density at the point drawn, and at the direction that it is rounded to: closest to the horizon they differ
        const float rounding = 1e-4f + 1e-6f / wi.z[i] + 2e-3f / (wi.z[i] + wo.z[i]);
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

/// Largest weight over the mean, and the standard deviation over the mean.
struct Quality {
  double largest, deviation;
};

Quality quality(const Material& m, const Vec3f& wo) {
  const Draws d = draw(m, wo, 50000, 8);
  double sum = 0, square = 0, largest = 0;
  for (const float weight : d.weight) {
    const double w = static_cast<double>(weight);
    sum += w;
    square += w * w;
    largest = std::max(largest, w);
  }
  const double mean = sum / static_cast<double>(d.weight.size());
  return {largest / mean, std::sqrt(std::max(square / static_cast<double>(d.weight.size()) - mean * mean, 0.0)) / mean};
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
      const Quality q = quality(c.material, test::direction_at(cosine, 1));
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
  for (const Vec3f& wo : views()) EXPECT_LT(quality(m, wo).largest, 20) << wo.z;
}

TEST(SampleDistribution, WithoutTablesDirectionsAreCosineDistributed) {
  const Material m = test::material_of(test::usual_lobes()).prepare(EvalLevel::fast, false);
  EXPECT_FALSE(m.sampling());
  EXPECT_EQ(m.sampling_bytes(), 0u);
  EXPECT_TRUE(m.prepare(EvalLevel::fast, true).sampling());
  EXPECT_GT(m.prepare(EvalLevel::fast, true).sampling_bytes(), 100000u);
  for (const Vec3f& wo : views()) {
    const Draws d = draw(m, wo, 1000, 4);
    for (std::size_t i = 0; i < d.pdf.size(); ++i) {
      ASSERT_NEAR(d.pdf[i], d.wi.z[i] / 3.14159265f, 1e-6f);
      ASSERT_EQ(d.pdf[i], m.pdf(d.wi[i], wo));
    }
  }
}

}  // namespace

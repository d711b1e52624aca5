// SPDX-License-Identifier: Apache-2.0
// Does sample() draw what pdf() says, and do its weights integrate f cos? At wo from 0 to 85 degrees.
#include "support/chi_squared.h"
#include "support/hemisphere_grid.h"
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
          {"grid", material_of(usual_lobes(), synthetic_grid({}))},
          {"nothing", material_of({3, {}})}};
}

std::vector<Vec3f> views() {
  std::vector<Vec3f> w;
  for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0})
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

void check_view(const Material& m, const Vec3f& wo, double p_threshold) {
  const std::size_t n = 200000;
  const Draws d = draw(m, wo, n, 77);
  const test::HemisphereGrid grid;
  const test::CellIntegrals integrals = test::integrate(m, wo, grid);
  std::vector<double> observed(grid.cells(), 0.0), expected = integrals.pdf;
  double rejected = 0, sum = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = static_cast<double>(d.weight[i]);
    sum += w;
    square += w * w;
    if (d.pdf[i] > 0)
      ++observed[grid.cell_of(d.wi[i])];
    else
      ++rejected;
  }
  const double count = static_cast<double>(n), total = std::accumulate(expected.begin(), expected.end(), 0.0);
  const double share = rejected / count, sigma = std::sqrt(share * (1 - share) / count);
  EXPECT_NEAR(total + share, 1, 1e-3 + 4 * sigma);
  for (double& e : expected) e *= count;
  observed.push_back(rejected);
  expected.push_back(count * std::max(1 - total, 0.0));
  if (expected.back() < 8) observed.pop_back(), expected.pop_back();
  EXPECT_GT(test::chi_squared_p_value(observed, expected), p_threshold);

  const double mean = sum / count, error = std::sqrt(std::max(square / count - mean * mean, 0.0) / count);
  const double integral = std::accumulate(integrals.f_cos.begin(), integrals.f_cos.end(), 0.0);
  EXPECT_NEAR(mean, integral, 4 * error + 1e-3 * integral);
  std::vector<float> albedo(static_cast<std::size_t>(m.channels()));
  m.albedo(wo, albedo);
  EXPECT_NEAR(static_cast<double>(albedo[0]), integral, 2e-3 * integral);
}

TEST(SampleDistribution, HistogramsFollowThePdfAndWeightsIntegrateTheMaterial) {
  const std::vector<Case> all = cases();
  const std::vector<Vec3f> directions = views();
  const double threshold = test::sidak_threshold(0.01, static_cast<int>(all.size() * directions.size()));
  for (const Case& c : all)
    for (const Vec3f& wo : directions) {
      SCOPED_TRACE(c.name + " at cos " + std::to_string(wo.z));
      check_view(c.material, wo, threshold);
    }
}

TEST(SampleDistribution, EveryTargetDrawsTheSameDirections) {
  const auto close = [](float a, float b, float bound) { return std::fabs(a - b) <= bound; };
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const std::size_t n = 3001;
    const DirectionBatch u = test::random_numbers(n, 5), wo = test::random_directions(n, 6);
    test::on_every_target([&] {
      DirectionBatch wi(n);
      std::vector<float> pdf(n), weight(3 * n), single(3), value(3), again(n), f(3 * n);
      c.material.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n});
      c.material.eval_pdf(wi.span(), wo.span(), {f.data(), n}, again.data());
      EXPECT_EQ(pdf, again);  // the very pdf that pdf() returns
      std::size_t other = 0;  // u.x within rounding of the border between two components may fall either way
      for (std::size_t i = 0; i < n; ++i) {
        const Sample s = c.material.sample(wo[i], u[i], single);
        other += !(close(s.wi.x, wi.x[i], 2e-5f) && close(s.wi.y, wi.y[i], 2e-5f) && close(s.wi.z, wi.z[i], 2e-5f));
        for (std::size_t k = 0; k < 3; ++k) {
          const float expected = pdf[i] > 0 ? f[k * n + i] * wi.z[i] / pdf[i] : 0.0f;
          ASSERT_NEAR(weight[k * n + i], expected, 1e-6f * expected);
        }
        ASSERT_EQ(s.pdf, s.flags == sample_reflection ? c.material.eval_pdf(s.wi, wo[i], value) : 0.0f);
        for (std::size_t k = 0; k < 3; ++k) {
          const float expected = s.pdf > 0 ? value[k] * s.wi.z / s.pdf : 0.0f;
          ASSERT_NEAR(single[k], expected, 1e-6f * expected);
        }
      }
      EXPECT_LE(other, n / 500);
    });
  }
}

TEST(SampleDistribution, WeightsOfAGridMaterialStayBounded) {
  // the ratio rises by e where no lobe reaches; only the share of the cosine lobe bounds the weight there
  const Material m = test::material_of(test::usual_lobes(), test::synthetic_grid({}, 1.0));
  for (const Vec3f& wo : views()) {
    const Draws d = draw(m, wo, 50000, 8);
    float largest = 0;
    for (float w : d.weight) largest = std::max(largest, w);
    EXPECT_LT(largest, 20.0f) << wo.z;
  }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// Residuals and Jacobian of the solver's cost function.
#include "fit/collect_samples.h"
#include "fit/log_ratio_cost.h"
#include "fit/robust_loss.h"
#include "fit/solve.h"
#include "lobes/lambert.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace brdf::fit {
namespace {

constexpr int columns = 3 + 5 + 5;
using Jet = ceres::Jet<double, columns>;

PreparedSamples some_samples() {
  const LobeSet truth{3, {{LobeKind::lambert, 1, 1, {0.1, 0.2, 0.0}}, {LobeKind::ggx, 0.1, 1, {0.04, 0.05, 0.3}}}};
  const auto lookup = [&](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    eval_lobes(truth, wi, wo, f);
    return true;
  };
  return prepare_samples(collect_samples(lookup, 3, 300));
}

const Layout& layout() {
  static const Layout l({LobeKind::lambert, LobeKind::ggx, LobeKind::retro_ggx}, 3);
  return l;
}

/// The documented residual, written once more for automatic differentiation: sqrt(rho) in its plain form.
Jet expected_row(const PreparedSamples& samples, const std::vector<double>& p, std::size_t s, std::size_t c) {
  std::vector<Jet> q;
  for (int k = 0; k < columns; ++k) q.push_back(exp(Jet(p[static_cast<std::size_t>(k)], k)));
  Jet model = lobes::lambert(q[c]);
  for (const std::size_t first : {3U, 8U}) {
    const lobes::LobeGeometry& g = first == 3 ? samples.mirror[s] : samples.retro[s];
    model += lobes::ggx_shape(g, q[first]) * lobes::schlick(q[first + 2 + c], q[first + 1], g.schlick_weight);
  }
  const Jet u = samples.log_target[s * 3 + c] - log(model * samples.cos_i[s] + log_offset);
  const double b2 = loss_width * loss_width;
  const Jet rho = 2 * b2 * (sqrt(1.0 + u * u / b2) - 1.0);
  return samples.root_weight[s] * (u.a < 0 ? -sqrt(rho) : sqrt(rho));
}

TEST(FitCost, JacobianMatchesAutomaticDifferentiation) {
  const PreparedSamples samples = some_samples();
  const LogRatioCost cost(samples, layout(), 100, 300);
  ASSERT_EQ(cost.num_residuals(), 600);
  std::mt19937_64 rng(4);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 20; ++n) {
    std::vector<double> p(columns);
    for (double& v : p) v = -3 + 4 * u(rng);
    p[3] = std::log(1e-3) * u(rng), p[8] = std::log(1e-3) * u(rng);
    std::vector<double> rows(600), jacobian(600 * columns);
    const double* const block = p.data();
    double* const j = jacobian.data();
    ASSERT_TRUE(cost.Evaluate(&block, rows.data(), const_cast<double**>(&j)));
    std::vector<double> without(600);
    ASSERT_TRUE(cost.Evaluate(&block, without.data(), nullptr));
    for (std::size_t r = 0; r < 600; ++r) {
      const Jet e = expected_row(samples, p, 100 + r / 3, r % 3);
      EXPECT_NEAR(rows[r], e.a, 1e-7);  // the plain form loses digits at small u
      EXPECT_NEAR(rows[r], without[r], 1e-12);
      for (std::size_t k = 0; k < columns; ++k) {
        EXPECT_NEAR(jacobian[r * columns + k], e.v[static_cast<int>(k)],
                    1e-6 * (1 + std::abs(e.v[static_cast<int>(k)])));
      }
    }
    if (HasFailure()) return;
  }
}

TEST(FitCost, JacobianMatchesFiniteDifferences) {
  const PreparedSamples samples = some_samples();
  const LogRatioCost cost(samples, layout(), 0, 300);
  std::vector<double> p(columns, -1.0), jacobian(900 * columns), rows(900), low(900), high(900);
  p[3] = -2.5;
  double* const j = jacobian.data();
  const double* block = p.data();
  ASSERT_TRUE(cost.Evaluate(&block, rows.data(), const_cast<double**>(&j)));
  const double h = 1e-5;
  for (std::size_t k = 0; k < columns; ++k) {
    std::vector<double> q = p;
    block = q.data();
    q[k] = p[k] - h;
    cost.Evaluate(&block, low.data(), nullptr);
    q[k] = p[k] + h;
    cost.Evaluate(&block, high.data(), nullptr);
    for (std::size_t r = 0; r < 900; ++r) {
      ASSERT_NEAR(jacobian[r * columns + k], (high[r] - low[r]) / (2 * h), 1e-7) << "column " << k << " row " << r;
    }
  }
}

TEST(FitCost, VanishesForTheTruth) {
  const PreparedSamples samples = some_samples();
  const LobeSet truth{
      3,
      {{LobeKind::lambert, 1, 1, {0.1 / samples.scale, 0.2 / samples.scale, 0}},
       {LobeKind::ggx, 0.1, 1 / samples.scale, {0.04 / samples.scale, 0.05 / samples.scale, 0.3 / samples.scale}}}};
  EXPECT_LT(mean_loss(samples, layout_of(truth), to_parameters(truth), samples.size()), 1e-10);
}

TEST(FitCost, SoftL1GrowsLinearlyAndStaysSmoothAtZero) {
  EXPECT_EQ(soft_l1(0).value, 0);
  EXPECT_DOUBLE_EQ(soft_l1(0).slope, 1);
  for (const double u : {-9.0, -0.3, 1e-4, 0.7, 30.0}) {
    const double b2 = loss_width * loss_width, rho = 2 * b2 * (std::sqrt(1 + u * u / b2) - 1);
    EXPECT_NEAR(soft_l1(u).value * soft_l1(u).value, rho, 1e-7 * rho);
    EXPECT_NEAR(soft_l1(u).slope, (soft_l1(u + 1e-6).value - soft_l1(u - 1e-6).value) / 2e-6, 1e-8);
    EXPECT_EQ(u < 0, soft_l1(u).value < 0);
  }
}

TEST(FitParameters, SurviveTheRoundTripAndTheirBounds) {
  const LobeSet set{2, {{LobeKind::lambert, 1, 1, {0.5, 0.25}}, {LobeKind::retro_ggx, 0.02, 3, {0.125, 7}}}};
  const LobeSet back = from_parameters(layout_of(set), to_parameters(set));
  ASSERT_EQ(back.lobes.size(), 2U);
  EXPECT_EQ(back.lobes[1].kind, LobeKind::retro_ggx);
  EXPECT_NEAR(back.lobes[1].alpha, 0.02, 1e-15);
  EXPECT_NEAR(back.lobes[1].f90, 3, 1e-14);
  EXPECT_NEAR(back.lobes[0].color[1], 0.25, 1e-15);
  EXPECT_NEAR(back.lobes[1].color[1], 7, 1e-14);
  const LobeSet extreme{1, {{LobeKind::ggx, 0, 0, {0}}, {LobeKind::ggx, 5, 1e300, {1e300}}}};
  const std::vector<double> p = to_parameters(extreme);
  const auto [lower, upper] = parameter_bounds(layout_of(extreme));
  for (std::size_t k = 0; k < p.size(); ++k) {
    EXPECT_GE(p[k], lower[k]);
    EXPECT_LE(p[k], upper[k]);
  }
}

}  // namespace
}  // namespace brdf::fit

// SPDX-License-Identifier: Apache-2.0
// Hand-written derivatives of the lobes against automatic and finite differentiation.
#include "lobes/lambert.h"
#include "lobes/lobe_jacobian.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace brdf::lobes {
namespace {

struct Case {
  LobeKind kind;
  Vec3d wi, wo;
  double alpha, f90, color;
};

/// Uniform directions, and every third pair close to the peak of the lobe, where values change fastest.
Case random_case(std::mt19937_64& rng) {
  std::uniform_real_distribution<double> u(0, 1);
  const auto direction = [&] {
    const double z = std::max(u(rng), 1e-3), phi = 2 * pi * u(rng), r = std::sqrt(1 - z * z);
    return Vec3d{r * std::cos(phi), r * std::sin(phi), z};
  };
  Case c{u(rng) < 0.5 ? LobeKind::ggx : LobeKind::retro_ggx, direction(), direction(), 0, u(rng) * 3, u(rng) * 2};
  c.alpha = std::exp(std::log(1e-4) * u(rng));
  if (u(rng) < 0.33) {
    const double t = c.alpha * u(rng), sign = c.kind == LobeKind::ggx ? -1 : 1;
    Vec3d near{sign * c.wi.x + t, sign * c.wi.y, c.wi.z};
    c.wo = near / std::sqrt(near.x * near.x + near.y * near.y + near.z * near.z);
  }
  return c;
}

TEST(LobeJacobian, MatchesAutomaticDifferentiation) {
  std::mt19937_64 rng(1);
  for (int n = 0; n < 20000; ++n) {
    const Case k = random_case(rng);
    using Jet = ceres::Jet<double, 3>;
    const Jet alpha(k.alpha, 0), f90(k.f90, 1), color(k.color, 2);
    const LobeGeometry g = lobe_geometry(k.kind, k.wi, k.wo);
    const Jet expected = ggx_shape(g, alpha) * schlick(color, f90, g.schlick_weight);

    const Lobe lobe{k.kind, k.alpha, k.f90, {k.color}};
    std::array<double, 4> v{};
    lobe_jacobian(lobe, k.wi, k.wo, {{&v[0], 1}, {&v[1], 1}, {&v[2], 1}, {&v[3], 1}});
    // the derivative by alpha changes sign where its terms cancel: there only its size beside value / alpha matters
    EXPECT_NEAR(v[0], expected.a, 1e-12 * expected.a);
    EXPECT_NEAR(v[1], expected.v[0], 1e-10 * (std::abs(expected.v[0]) + expected.a / k.alpha)) << "alpha " << k.alpha;
    EXPECT_NEAR(v[2], expected.v[1], 1e-12 * std::abs(expected.v[1]) + 1e-300);
    EXPECT_NEAR(v[3], expected.v[2], 1e-12 * std::abs(expected.v[2]) + 1e-300);
    if (HasFailure()) return;
  }
}

TEST(LobeJacobian, MatchesFiniteDifferencesOfEvalLobes) {
  std::mt19937_64 rng(2);
  for (int n = 0; n < 5000; ++n) {
    const Case k = random_case(rng);
    const Lobe lobe{k.kind, k.alpha, k.f90, {k.color, 0.5 * k.color}};
    const auto value = [&](const Lobe& at, std::size_t channel) {
      std::array<double, 2> f{};
      eval_lobes({2, {at}}, k.wi, k.wo, f);
      return f[channel];
    };
    std::array<std::array<double, 2>, 4> v{};
    lobe_jacobian(lobe, k.wi, k.wo, {v[0], v[1], v[2], v[3]});
    const double h = 1e-5;
    for (std::size_t c = 0; c < 2; ++c) {
      const double scale = value(lobe, c);  // summed in another order than in lobe_jacobian
      EXPECT_NEAR(v[0][c], scale, 1e-13 * scale);
      Lobe low = lobe, high = lobe;
      low.alpha = k.alpha * (1 - h), high.alpha = std::min(k.alpha * (1 + h), max_alpha);
      EXPECT_NEAR(v[1][c], (value(high, c) - value(low, c)) / (high.alpha - low.alpha), 2e-5 * scale / k.alpha);
      low = lobe, high = lobe;
      low.f90 -= h, high.f90 += h;
      EXPECT_NEAR(v[2][c], (value(high, c) - value(low, c)) / (2 * h), 1e-7 * (v[2][c] + v[3][c]));
      low = lobe, high = lobe;
      low.color[c] -= h, high.color[c] += h;
      EXPECT_NEAR(v[3][c], (value(high, c) - value(low, c)) / (2 * h), 1e-7 * (v[2][c] + v[3][c]));
    }
    if (HasFailure()) return;
  }
}

TEST(LobeJacobian, LambertDependsOnItsColorAlone) {
  const Lobe lobe{LobeKind::lambert, 1, 1, {0.25, 0.5}};
  std::array<std::array<double, 2>, 4> v{};
  v[1] = v[2] = {7, 7};
  lobe_jacobian(lobe, {0.6, 0, 0.8}, {0, 0.6, 0.8}, {v[0], v[1], v[2], v[3]});
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_DOUBLE_EQ(v[0][c], lobe.color[c] / pi);
    EXPECT_EQ(v[1][c], 0);
    EXPECT_EQ(v[2][c], 0);
    EXPECT_DOUBLE_EQ(v[3][c], 1 / pi);
  }
}

TEST(LobeJacobian, IsZeroBelowTheHorizon) {
  const Lobe lobe{LobeKind::ggx, 0.3, 1, {0.5}};
  std::array<double, 4> v{1, 2, 3, 4};
  lobe_jacobian(lobe, {0.6, 0, -0.8}, {0, 0.6, 0.8}, {{&v[0], 1}, {&v[1], 1}, {&v[2], 1}, {&v[3], 1}});
  for (const double x : v) EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace brdf::lobes

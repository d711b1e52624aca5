// SPDX-License-Identifier: Apache-2.0
// Values of the lobes against their formulas as written in <brdf/lobes.h>.
#include "lobes/ggx.h"

#include <brdf/lobes.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace brdf {
namespace {

constexpr double pi = 3.14159265358979323846;

double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3d normalized(const Vec3d& v) { return v / std::sqrt(dot(v, v)); }

/// The formulas of the header, term by term, with no care for numerics.
double textbook_ggx(const Vec3d& wi, const Vec3d& wo, double alpha, double f0, double f90) {
  const Vec3d h = normalized(wi + wo);
  const double a2 = alpha * alpha, q = h.z * h.z * (a2 - 1) + 1, ndf = a2 / (pi * q * q);
  const auto lambda = [&](double c) { return (-1 + std::sqrt(1 + a2 * (1 - c * c) / (c * c))) / 2; };
  const double g2 = 1 / (1 + lambda(wi.z) + lambda(wo.z));
  const double f = f0 + (f90 - f0) * std::pow(1 - dot(wi, h), 5);
  return f * ndf * g2 / (4 * wi.z * wo.z);
}

TEST(EvalLobes, GgxFollowsTheFormulas) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 20000; ++n) {
    const auto direction = [&] {
      const double z = 0.02 + 0.98 * u(rng), phi = 2 * pi * u(rng), r = std::sqrt(1 - z * z);
      return Vec3d{r * std::cos(phi), r * std::sin(phi), z};
    };
    const Vec3d wi = direction(), wo = direction();
    const double alpha = 0.05 + 0.95 * u(rng), f0 = u(rng), f90 = u(rng);
    std::array<double, 1> f{};
    eval_lobes({1, {{LobeKind::ggx, alpha, f90, {f0}}}}, wi, wo, f);
    const double expected = textbook_ggx(wi, wo, alpha, f0, f90);
    ASSERT_NEAR(f[0], expected, 1e-9 * expected);
    eval_lobes({1, {{LobeKind::retro_ggx, alpha, f90, {f0}}}}, wi, {-wo.x, -wo.y, wo.z}, f);
    ASSERT_NEAR(f[0], expected, 1e-9 * expected);
  }
}

TEST(EvalLobes, PiecesOfGgxFitTogether) {
  for (const double alpha : {1e-5, 1e-3, 0.1, 1.0}) {
    for (const double ci : {1e-6, 0.01, 0.3, 1.0}) {
      for (const double co : {0.01, 0.5, 1.0}) {
        const double expected = lobes::ggx_g2(ci, co, alpha) / (4 * ci * co);
        EXPECT_NEAR(lobes::ggx_visibility(std::min(ci, co), std::max(ci, co), alpha), expected, 1e-10 * expected);
      }
    }
  }
}

TEST(EvalLobes, NarrowestPeakKeepsItsDigits) {
  // half vector at theta_h = x alpha, exact D(x) = 1 / (pi alpha^2 (1 + x^2)^2) up to alpha^2
  const double alpha = 1e-5;
  for (const double x : {0.0, 0.5, 1.0, 4.0}) {
    const double theta = x * alpha;
    const Vec3d w{std::sin(theta), 0, std::cos(theta)};
    std::array<double, 1> f{};
    eval_lobes({1, {{LobeKind::ggx, alpha, 1, {1}}}}, w, w, f);
    const double expected = 1 / (pi * alpha * alpha * (1 + x * x) * (1 + x * x)) / 4;
    EXPECT_NEAR(f[0], expected, 1e-8 * expected) << x;
  }
}

TEST(EvalLobes, AddsUpItsLobes) {
  const Lobe diffuse{LobeKind::lambert, 1, 1, {0.1, 0.2, 0.3}}, coat{LobeKind::ggx, 0.2, 1, {0.04, 0.05, 0.06}};
  const Vec3d wi{0.6, 0, 0.8}, wo{-0.48, 0.36, 0.8};
  std::array<double, 3> a{}, b{}, both{};
  eval_lobes({3, {diffuse}}, wi, wo, a);
  eval_lobes({3, {coat}}, wi, wo, b);
  eval_lobes({3, {diffuse, coat}}, wi, wo, both);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_DOUBLE_EQ(a[c], diffuse.color[c] / pi);
    EXPECT_DOUBLE_EQ(both[c], a[c] + b[c]);
  }
}

TEST(EvalLobes, IsZeroAtAndBelowTheHorizon) {
  const LobeSet set{1, {{LobeKind::lambert, 1, 1, {0.5}}, {LobeKind::ggx, 0.5, 1, {0.5}}}};
  for (const double z : {0.0, -0.1, -1.0, std::nan("")}) {
    const Vec3d low{std::sqrt(std::max(0.0, 1 - z * z)), 0, z}, up{0, 0, 1};
    std::array<double, 1> f{9};
    eval_lobes(set, low, up, f);
    EXPECT_EQ(f[0], 0);
    f[0] = 9;
    eval_lobes(set, up, low, f);
    EXPECT_EQ(f[0], 0);
  }
}

TEST(EvalLobes, WritesZeroIntoChannelsThatNoLobeHas) {
  std::array<double, 3> f{9, 9, 9};
  eval_lobes({3, {}}, {0, 0, 1}, {0, 0, 1}, f);
  EXPECT_EQ(f, (std::array<double, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// What must hold for any lobes and any directions: reciprocity, sign, finiteness, energy.
#include <brdf/lobes.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

namespace brdf {
namespace {

constexpr double pi = 3.14159265358979323846;

/// [0, 1), whatever size the generator is at.
rc::Gen<double> unit() {
  return rc::gen::map(rc::gen::noShrink(rc::gen::resize(1000, rc::gen::arbitrary<std::uint32_t>())),
                      [](std::uint32_t v) { return v / 4294967296.0; });
}

/// Unit vectors above the horizon, half of them near grazing or near the normal.
rc::Gen<Vec3d> direction() {
  return rc::gen::map(rc::gen::tuple(unit(), unit(), unit()), [](const std::tuple<double, double, double>& u) {
    const auto [a, b, c] = u;
    double theta = a * pi / 2;
    if (c < 0.25) theta = std::pow(10.0, -10 * a);
    if (c > 0.75) theta = pi / 2 - std::pow(10.0, -10 * a);
    return Vec3d{std::sin(theta) * std::cos(2 * pi * b), std::sin(theta) * std::sin(2 * pi * b), std::cos(theta)};
  });
}

rc::Gen<Lobe> lobe() {
  return rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 3), unit(), unit(), unit(), unit()),
                      [](const std::tuple<int, double, double, double, double>& u) {
                        const auto [kind, a, f, r, g] = u;
                        return Lobe{static_cast<LobeKind>(kind), std::pow(10.0, -5 * a), 2 * f, {r, g}};
                      });
}

LobeSet lobe_set() { return {2, *rc::gen::container<std::vector<Lobe>>(4, lobe())}; }

RC_GTEST_PROP(LobesPhysics, ExchangeOfDirectionsGivesTheSameBits, ()) {
  const LobeSet set = lobe_set();
  const Vec3d wi = *direction(), wo = *direction();
  std::array<double, 2> there{}, back{};
  eval_lobes(set, wi, wo, there);
  eval_lobes(set, wo, wi, back);
  RC_ASSERT(there == back);
}

RC_GTEST_PROP(LobesPhysics, ExchangeHoldsInsideThePeaks, ()) {
  const LobeSet set = lobe_set();
  const Vec3d wi = *direction();
  const double t = std::pow(10.0, -8 * *unit()), sign = *unit() < 0.5 ? 1 : -1;
  Vec3d wo{sign * wi.x + t, sign * wi.y, wi.z};
  wo /= std::sqrt(wo.x * wo.x + wo.y * wo.y + wo.z * wo.z);
  std::array<double, 2> there{}, back{};
  eval_lobes(set, wi, wo, there);
  eval_lobes(set, wo, wi, back);
  RC_ASSERT(there == back);
}

RC_GTEST_PROP(LobesPhysics, ValuesAreFiniteAndNotNegative, ()) {
  const LobeSet set = lobe_set();
  std::array<double, 2> f{};
  eval_lobes(set, *direction(), *direction(), f);
  for (const double v : f) RC_ASSERT(std::isfinite(v) && v >= 0);
}

TEST(LobesPhysics, ExchangeHoldsForManyPairs) {
  std::mt19937_64 rng(5);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 200000; ++n) {
    const auto direction_of = [](double z, double phi) {
      return Vec3d{std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
    };
    const Vec3d wi = direction_of(u(rng), 2 * pi * u(rng)), wo = direction_of(u(rng), 2 * pi * u(rng));
    const double alpha = std::pow(10.0, -5 * u(rng));
    const LobeSet set{1, {{LobeKind::ggx, alpha, 1, {0.3}}, {LobeKind::retro_ggx, alpha, 0.5, {0.2}}}};
    std::array<double, 1> there{}, back{};
    eval_lobes(set, wi, wo, there);
    eval_lobes(set, wo, wi, back);
    ASSERT_EQ(there, back);
  }
}

TEST(LobesPhysics, StaysFiniteWhereBothCosinesVanish) {
  for (const double z : {1e-12, 1e-100, 1e-308, 5e-324}) {
    for (const double alpha : {1e-5, 1e-2, 1.0}) {
      for (const LobeKind kind : {LobeKind::ggx, LobeKind::retro_ggx}) {
        std::array<double, 1> f{};
        eval_lobes({1, {{kind, alpha, 1, {1}}}}, {1, 0, z}, {-1, 0, z}, f);
        EXPECT_TRUE(std::isfinite(f[0]) && f[0] >= 0) << z << " " << alpha;
      }
    }
  }
}

/// Integral of f cos_i over the hemisphere of wi, in half-vector coordinates around the peak: theta_h = atan(alpha x)
/// spreads a narrow lobe over the whole range of x = tan(v). dwi = 4 (wo.h) dwh.
double albedo(const Lobe& lobe, double cos_o) {
  const Vec3d wo{std::sqrt(1 - cos_o * cos_o), 0, cos_o};
  const LobeSet set{1, {lobe}};
  const int n_v = 800, n_phi = 400;
  double sum = 0;
  for (int i = 0; i < n_v; ++i) {
    const double v = (i + 0.5) / n_v * pi / 2, x = std::tan(v), tan_h = lobe.alpha * x;
    const double cos_h = 1 / std::sqrt(1 + tan_h * tan_h), sin_h = tan_h * cos_h;
    const double dtheta = lobe.alpha * (1 + x * x) * cos_h * cos_h * (pi / 2 / n_v);
    for (int k = 0; k < n_phi; ++k) {
      const double phi = (k + 0.5) / n_phi * pi;  // mirror symmetric: half of the circle, counted twice
      const Vec3d h{sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h};
      const double oh = wo.x * h.x + wo.z * h.z;
      if (oh <= 0) continue;
      const Vec3d wi = 2 * oh * h - wo;
      if (wi.z <= 0) continue;
      std::array<double, 1> f{};
      eval_lobes(set, wi, wo, f);
      sum += f[0] * wi.z * 4 * oh * sin_h * dtheta * (2 * pi / n_phi);
    }
  }
  return sum;
}

TEST(LobesPhysics, WhiteFurnaceNeverGainsEnergy) {
  for (const double alpha : {0.05, 0.1, 0.2, 0.4, 0.7, 1.0}) {
    for (const double cos_o : {1.0, 0.8, 0.5, 0.2, 0.05}) {
      const double a = albedo({LobeKind::ggx, alpha, 1, {1}}, cos_o);
      EXPECT_LE(a, 1 + 1e-3) << "alpha " << alpha << " cos " << cos_o;
      EXPECT_GT(a, alpha < 0.3 ? 0.8 : 0.3) << "alpha " << alpha << " cos " << cos_o;
    }
  }
  // the quadrature itself is right: at alpha 1 and normal incidence D = 1 / pi and the integral is 1 - log 2
  EXPECT_NEAR(albedo({LobeKind::ggx, 1.0, 1, {1}}, 1.0), 1 - std::log(2.0), 1e-5);
}

TEST(LobesPhysics, RetroLobeReflectsAsMuchAsItsMirrorImage) {
  // turning wo about the normal permutes the hemisphere, so the albedo is that of the mirror lobe
  const double cos_o = 0.6, sin_o = 0.8;
  double mirror = 0, retro = 0;
  const int n_t = 400, n_p = 800;
  for (int i = 0; i < n_t; ++i) {
    const double c = (i + 0.5) / n_t, s = std::sqrt(1 - c * c);
    for (int k = 0; k < n_p; ++k) {
      const double phi = (k + 0.5) / n_p * 2 * pi;
      const Vec3d wi{s * std::cos(phi), s * std::sin(phi), c}, wo{sin_o, 0, cos_o};
      std::array<double, 1> f{};
      eval_lobes({1, {{LobeKind::ggx, 0.3, 1, {0.5}}}}, wi, wo, f);
      mirror += f[0] * c * 2 * pi / (n_t * n_p);
      eval_lobes({1, {{LobeKind::retro_ggx, 0.3, 1, {0.5}}}}, wi, wo, f);
      retro += f[0] * c * 2 * pi / (n_t * n_p);
    }
  }
  EXPECT_NEAR(retro, mirror, 1e-9);
  EXPECT_GT(retro, 0.3);
}

}  // namespace
}  // namespace brdf

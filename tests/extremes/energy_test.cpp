// SPDX-License-Identifier: Apache-2.0
// White furnace: what a lobe of F = 1 returns, by adaptive quadrature, without and with compensation.
#include "extremes/adaptive_quadrature.h"
#include "support/numeric_bound.h"

#include <brdf/error.h>
#include <brdf/ggx_energy.h>
#include <brdf/lobes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

namespace brdf::test {
namespace {

constexpr double pi = std::numbers::pi;
const char* const group = "Energy of white lobes";

struct Roughness {
  double alpha, largest_loss;
  const char* name;
};
const Roughness roughness[] = {{1e-5, 0.12, "1e-5"}, {1e-3, 0.12, "1e-3"}, {0.01, 0.12, "0.01"}, {0.1, 0.12, "0.1"},
                               {0.3, 0.25, "0.3"},   {0.5, 0.4, "0.5"},    {0.7, 0.55, "0.7"},   {1, 0.7, "1"}};

struct Furnace {
  NumericBound gain, loss, compensated;
  explicit Furnace(const Roughness& r)
      : gain(group, std::string("alpha ") + r.name + ", GGX and retro: albedo above 1", "absolute", 1e-6),
        loss(group, std::string("alpha ") + r.name + ", GGX and retro: loss", "absolute", r.largest_loss),
        compensated(group, std::string("alpha ") + r.name + ", with compensation: albedo from 1", "absolute", 5e-4) {}
};

std::deque<Furnace> declare() {
  std::deque<Furnace> all;
  for (const Roughness& r : roughness) all.emplace_back(r);
  return all;
}
std::deque<Furnace> furnaces = declare();

/// Integral of f cos_i over wi, in half vectors: tan theta_h = alpha tan v, d omega_i = 4 (wo . h) d omega_h. `turn` is -1
/// for retro lobes, whose half vectors are those of the view turned by pi about the normal.
double albedo(const Lobe& lobe, double cos_o) {
  const double turn = lobe.kind == LobeKind::retro_ggx ? -1 : 1, sin_o = std::sqrt((1 - cos_o) * (1 + cos_o));
  const Vec3d view{sin_o, 0, cos_o}, wo{turn * sin_o, 0, cos_o};
  const LobeSet set{1, {lobe}};
  const auto over_azimuth = [&](double phi) {
    const double x = sin_o * std::cos(phi), r = std::hypot(cos_o, x);
    const double end = std::atan((x >= 0 ? (r + x) / cos_o : cos_o / (r - x)) / lobe.alpha);  // where wi meets the horizon
    return integrate(
        [&](double v) {
          const double t = lobe.alpha * std::tan(v), cos_h = 1 / std::sqrt(1 + t * t), sin_h = t * cos_h, slope = 1 / std::cos(v);
          const Vec3d h{sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h};
          const double oh = view.x * h.x + view.z * h.z;
          const Vec3d wi = 2 * oh * h - view;
          if (!(wi.z > 0) || !(oh > 0)) return 0.0;
          double f[1];
          eval_lobes(set, wi, wo, f);
          return f[0] * wi.z * 4 * oh * sin_h * lobe.alpha * slope * slope * cos_h * cos_h;
        },
        0, end, 1e-8);
  };
  return 2 * (integrate(over_azimuth, 0, pi / 2, 1e-8) + integrate(over_azimuth, pi / 2, pi, 1e-8));
}

std::vector<double> cosines(double alpha) {
  std::vector<double> all = {1, 0.9, 0.7, 0.5, 0.3, 0.1, 0.02, 2e-3, 1e-4};
  for (const double share : {0.1, 0.3, 1.0, 3.0, 10.0})
    if (share * alpha < 1) all.push_back(share * alpha);
  return all;
}

TEST(Energy, LobesNeverGainAndLoseWhatIsStated) {
  for (std::size_t i = 0; i < std::size(roughness); ++i) {
    for (const double mu : cosines(roughness[i].alpha))
      for (const LobeKind kind : {LobeKind::ggx, LobeKind::retro_ggx}) {
        const double a = albedo({kind, roughness[i].alpha, 1, {1}}, mu);
        const auto where = [&] { return "cos theta " + numbers({mu}); };
        furnaces[i].gain.see(std::max(a - 1, 0.0), where);
        furnaces[i].loss.see(1 - a, where);
      }
    furnaces[i].gain.check();
    furnaces[i].loss.check();
  }
}

TEST(Energy, CompensationReturnsWhatIsLost) {
  for (std::size_t i = 0; i < std::size(roughness); ++i) {
    const double alpha = roughness[i].alpha;
    const GgxEnergy energy(alpha);
    for (const double mu : cosines(alpha)) {
      const double once = albedo({LobeKind::ggx, alpha, 1, {1}}, mu);
      // in log cosine: losses live at cosines of about alpha
      const double later = integrate([&](double t) { return std::exp(2 * t) * 2 * pi * energy.compensation(std::exp(t), mu); },
                                     std::log(1e-9), 0, 1e-7);
      furnaces[i].compensated.see(std::fabs(once + later - 1), [&] { return "cos theta " + numbers({mu}); });
    }
    furnaces[i].compensated.check();
  }
}

NumericBound table(group, "GgxEnergy::albedo, all alphas: error", "absolute", 3e-4);

TEST(Energy, TheTableIsTheAlbedo) {
  for (const Roughness& r : roughness) {
    const GgxEnergy energy(r.alpha);
    for (const double mu : cosines(r.alpha))
      table.see(std::fabs(energy.albedo(mu) - albedo({LobeKind::ggx, r.alpha, 1, {1}}, mu)),
                [&] { return std::string("alpha ") + r.name + ", cos theta " + numbers({mu}); });
  }
  // known in closed form: at alpha 1 and normal incidence D = 1 / pi
  table.see(std::fabs(GgxEnergy(1).albedo(1) - (1 - std::log(2.0))), [] { return std::string("alpha 1, cos theta 1"); });
  table.check();
}

TEST(Energy, CompensationIsSymmetricAndBlackBelowTheHorizon) {
  const GgxEnergy energy(0.6);
  for (const double a : {1.0, 0.4, 1e-3})
    for (const double b : {0.8, 0.05, 1e-6}) {
      EXPECT_EQ(energy.compensation(a, b), energy.compensation(b, a));
      EXPECT_GT(energy.compensation(a, b), 0);
    }
  EXPECT_EQ(energy.compensation(0, 0.5), 0);
  EXPECT_EQ(energy.compensation(0.5, -0.1), 0);
  EXPECT_EQ(energy.compensation(0.5, std::nan("")), 0);
  EXPECT_EQ(energy.albedo(std::nan("")), 1);
  EXPECT_EQ(energy.compensation_color(1), 1);
  EXPECT_EQ(energy.compensation_color(0), 0);
  EXPECT_LT(energy.compensation_color(0.5), 0.5);
  EXPECT_NEAR(energy.albedo(0.3), 1 - energy.loss(0.3), 1e-15);
  EXPECT_NEAR(schlick_mean(0.04, 1), 1.8 / 21, 1e-15);
}

TEST(Energy, AlphasOutsideTheLobesRangeAreRefused) {
  for (const double alpha : {0.0, 9e-6, 1.01, std::nan("")}) {
    try {
      const GgxEnergy energy(alpha);
      ADD_FAILURE() << alpha << ' ' << energy.mean_albedo();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace brdf::test

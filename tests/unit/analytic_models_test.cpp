// SPDX-License-Identifier: Apache-2.0
// The four analytic models: closed forms, refusals, what a handle says of itself.
#include "support/direction_batch.h"

#include <brdf/fresnel.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace {

using namespace brdf;

std::array<float, 3> eval(const Material& m, const Vec3f& wi, const Vec3f& wo) {
  std::array<float, 3> f{-1, -1, -1};
  m.eval(wi, wo, f);
  return f;
}

TEST(AnalyticModels, LambertIsItsAlbedoOverPi) {
  const Material m = Material::from_analytic(Lambert{{0.5f, 0.25f, 1.0f}});
  const auto f = eval(m, test::direction_at(0.3, 1), test::direction_at(0.9, 4));
  EXPECT_FLOAT_EQ(f[0], 0.5f * std::numbers::inv_pi_v<float>);
  EXPECT_FLOAT_EQ(f[1], 0.25f * std::numbers::inv_pi_v<float>);
  EXPECT_FLOAT_EQ(f[2], std::numbers::inv_pi_v<float>);
  EXPECT_EQ(m.scatter_flags(), static_cast<std::uint32_t>(sample_reflection));
  EXPECT_TRUE(m.sampling());
  EXPECT_FLOAT_EQ(m.pdf(test::direction_at(0.3, 1), test::direction_at(0.9, 4)), 0.3f * std::numbers::inv_pi_v<float>);
  std::array<float, 3> weight{};
  const Sample s = m.sample(test::direction_at(0.2, 1), {0.5f, 0.3f, 0.8f}, weight);
  EXPECT_GT(s.wi.z, 0);
  EXPECT_NEAR(weight[0], 0.5f, 1e-5f);
  EXPECT_NEAR(weight[2], 1.0f, 1e-5f);
}

TEST(AnalyticModels, TheMirrorReturnsWhatArrives) {
  const Material m = Material::from_analytic(Mirror{{0.9f, 0.8f, 0.0f}});
  const Vec3f wo = test::direction_at(0.4, 2);
  std::array<float, 3> weight{};
  const Sample s = m.sample(wo, {0.5f, 0.5f, 0.5f}, weight);
  EXPECT_EQ(s.wi, Vec3f(-wo.x, -wo.y, wo.z));
  EXPECT_EQ(s.pdf, 1);
  EXPECT_EQ(s.eta, 1);
  EXPECT_EQ(s.flags, sample_reflection | sample_delta);
  EXPECT_EQ(weight, (std::array<float, 3>{0.9f, 0.8f, 0.0f}));
  EXPECT_EQ(eval(m, s.wi, wo), (std::array<float, 3>{}));
  EXPECT_EQ(m.pdf(s.wi, wo), 0);
  EXPECT_EQ(m.scatter_flags(), sample_reflection | sample_delta);
}

TEST(AnalyticModels, TheDielectricObeysSnellAndFresnel) {
  const float ior = 1.5f;
  const Material m = Material::from_analytic(Dielectric{ior, 1});
  for (const bool inside : {false, true})
    for (const double cosine : {1.0, 0.9, 0.75, 0.5, 0.1, 1e-4}) {
      Vec3f wo = test::direction_at(cosine, 2);
      if (inside) wo.z = -wo.z;
      const float eta = inside ? 1 / ior : ior;
      const FresnelSplit f = fresnel_split(static_cast<float>(cosine), eta);
      float weight = 0;
      const Sample up = m.sample(wo, {0, 0.5f, 0.5f}, {&weight, 1});
      EXPECT_EQ(up.wi, Vec3f(-wo.x, -wo.y, wo.z));
      EXPECT_NEAR(up.pdf, f.reflected, 1e-6f);
      EXPECT_EQ(up.flags, sample_reflection | sample_delta);
      EXPECT_EQ(up.eta, 1);
      EXPECT_EQ(weight, 1);
      if (f.transmitted == 0) continue;
      for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
        const Sample through = m.sample(wo, {0.999999f, 0.5f, 0.5f}, {&weight, 1}, mode);
        EXPECT_EQ(through.flags, sample_transmission | sample_delta);
        EXPECT_NEAR(through.pdf, f.transmitted, 1e-6f);
        EXPECT_FLOAT_EQ(through.eta, eta);
        EXPECT_FLOAT_EQ(weight, mode == TransportMode::radiance ? 1 / (eta * eta) : 1.0f);
        EXPECT_LT(through.wi.z * wo.z, 0);
        EXPECT_NEAR(through.wi.x * eta, -wo.x, 1e-6f);
        EXPECT_NEAR(through.wi.y * eta, -wo.y, 1e-6f);
        EXPECT_NEAR(std::hypot(through.wi.x, through.wi.y, through.wi.z), 1, 1e-6f);
      }
    }
  EXPECT_EQ(m.scatter_flags(), sample_reflection | sample_transmission | sample_delta);
  EXPECT_FALSE(m.info().reciprocal);
}

/// D G2 / (4 c_i c_o) as <brdf/analytic.h> writes it.
double facets(const GgxReflector& m, const Vec3d& wi, const Vec3d& wo) {
  const double ax = static_cast<double>(m.alpha_x), ay = static_cast<double>(m.alpha_y);
  const Vec3d s = wi + wo, h = s / std::hypot(s.x, s.y, s.z);
  const double q = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
  const auto lambda = [&](const Vec3d& w) {
    return 0.5 * (std::sqrt(1 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1);
  };
  return 1 / (std::numbers::pi * ax * ay * q * q) / (1 + lambda(wi) + lambda(wo)) / (4 * wi.z * wo.z);
}

TEST(AnalyticModels, GgxIsItsFormula) {
  const test::DirectionBatch wi = test::random_directions(300, 5), wo = test::random_directions(300, 6);
  for (const auto& [ax, ay] : {std::pair{0.3f, 0.3f}, std::pair{0.5f, 0.1f}, std::pair{0.05f, 1.0f}}) {
    const GgxReflector model{ax, ay, {0.04f, 0.5f, 1.0f}};
    const Material m = Material::from_analytic(model);
    for (std::size_t k = 0; k < wi.size(); ++k) {
      const Vec3d i(wi[k]), o(wo[k]);
      const double cos_d = std::sqrt(0.5 + 0.5 * (i.x * o.x + i.y * o.y + i.z * o.z)), shape = facets(model, i, o);
      const auto f = eval(m, wi[k], wo[k]);
      for (std::size_t c = 0; c < 3; ++c) {
        const double f0 = static_cast<double>(model.f0[c]), expected = shape * (f0 + (1 - f0) * std::pow(1 - cos_d, 5));
        EXPECT_NEAR(f[c], expected, 2e-5 * expected) << ax << ' ' << ay << ' ' << k;
      }
      EXPECT_EQ(f, eval(m, wo[k], wi[k]));
    }
  }
}

TEST(AnalyticModels, TwoRoughnessesThatMeetAreOne) {
  const Material one = Material::from_analytic(GgxReflector{0.25f, 0.25f, {0.3f}});
  const Material two = Material::from_analytic(GgxReflector{0.25f, std::nextafter(0.25f, 1.0f), {0.3f}});
  const test::DirectionBatch wi = test::random_directions(100, 5), wo = test::random_directions(100, 6);
  for (std::size_t k = 0; k < wi.size(); ++k) {
    float f = 0, g = 0;
    one.eval(wi[k], wo[k], {&f, 1});
    two.eval(wi[k], wo[k], {&g, 1});
    EXPECT_NEAR(f, g, 1e-5f * f);
  }
  EXPECT_EQ(one.lobes().lobes.size(), 1U);
  EXPECT_TRUE(two.lobes().lobes.empty());
}

}  // namespace

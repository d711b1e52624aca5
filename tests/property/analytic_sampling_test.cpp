// SPDX-License-Identifier: Apache-2.0
// Analytic models draw what their pdf says; a pair, a sample and a batch agree; energy and reciprocity hold.
#include "support/analytic_models.h"
#include "support/chi_squared.h"
#include "support/direction_batch.h"
#include "support/sampling_checks.h"

#include <brdf/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

using namespace brdf;
using test::DirectionBatch;

/// Where alpha is 1, a density folded at the horizon jumps at the height of the view, and at 89.9 degrees that is within one
/// cell of the shared quadrature: see TheFoldedDensityIntegratesToOne.
bool too_steep(const test::NamedModel& m, const Vec3f& wo) {
  const auto* ggx = std::get_if<GgxReflector>(&m.model);
  return ggx != nullptr && ggx->alpha_x == 1 && ggx->alpha_y == 1 && wo.z < 0.01f;
}

TEST(AnalyticSampling, SlowHistogramsFollowThePdfAndWeightsIntegrateTheMaterial) {
  const std::vector<test::NamedModel> all = test::spread_models();
  const std::vector<Vec3f> views = test::sampling_views();
  const double threshold = test::sidak_threshold(0.01, static_cast<int>(all.size() * views.size()));
  for (const test::NamedModel& m : all)
    for (const Vec3f& wo : views) {
      if (too_steep(m, wo)) continue;
      SCOPED_TRACE(m.name + " at cos " + std::to_string(wo.z));
      test::expect_sampling(Material::from_analytic(m.model), wo, 100000, threshold);
    }
}

// By cosine and azimuth, on both sides of the height at which the folded part ends.
TEST(AnalyticSampling, TheFoldedDensityIntegratesToOne) {
  for (const float alpha : {1.0f, 0.5f, 0.2f}) {
    const Material m = Material::from_analytic(GgxReflector{alpha, 0.8f * alpha, {1}});
    for (const double cosine : {1.0, 0.6, 0.1, 0.00174533, 1e-5}) {
      const Vec3f wo = test::direction_at(cosine, 0.3);
      constexpr int heights = 600, azimuths = 900;
      double total = 0;
      for (const bool below : {true, false}) {
        const double low = below ? 0 : cosine, width = below ? cosine : 1 - cosine;
        for (int i = 0; i < heights; ++i) {
          // by cubes: most heights at the horizon, where a grazing view is reflected to
          const double t = (i + 0.5) / heights, z = low + width * t * t * t;
          for (int j = 0; j < azimuths; ++j) {
            // and most azimuths opposite of the view
            const double turn = 2 * (j + 0.5) / azimuths - 1, phi = 0.3 + std::numbers::pi * (1 + turn * turn * turn);
            total += static_cast<double>(m.pdf(test::direction_at(z, phi), wo)) * width * 3 * t * t / heights * std::numbers::pi * 3 *
                     turn * turn * 2 / azimuths;
          }
        }
      }
      EXPECT_NEAR(total, 1, 1e-3) << alpha << " at " << cosine;
    }
  }
}

// The facets' weight is F G2 / G1 times at most 1.
TEST(AnalyticSampling, NoWeightExceedsOne) {
  const std::size_t n = 5000;
  const DirectionBatch u = test::random_numbers(n, 15);
  for (const test::NamedModel& named : test::spread_models()) {
    const Material m = Material::from_analytic(named.model);
    const auto* ggx = std::get_if<GgxReflector>(&named.model);
    if (ggx != nullptr && ggx->multiple_scattering) continue;
    std::vector<float> weight(static_cast<std::size_t>(m.channels()));
    for (const Vec3f& wo : test::sampling_views())
      for (std::size_t i = 0; i < n; ++i) {
        m.sample(wo, u[i], weight);
        for (const float w : weight) ASSERT_LE(w, 1 + 1e-5f) << named.name << " at cos " << wo.z;
      }
  }
}

TEST(AnalyticSampling, SingleCallsBatchesAndPairsAgree) {
  const std::size_t n = 2001;
  const DirectionBatch u = test::random_numbers(n, 5), above = test::random_directions(n, 6);
  for (const test::NamedModel& named : test::all_models()) {
    SCOPED_TRACE(named.name);
    const Material m = Material::from_analytic(named.model);
    const auto channels = static_cast<std::size_t>(m.channels());
    const bool delta = (m.scatter_flags() & sample_delta) != 0, through = (m.scatter_flags() & sample_transmission) != 0;
    DirectionBatch wo = above, wi(n);
    for (std::size_t i = 0; i < n; i += 2)
      if (through) wo.z[i] = -wo.z[i];
    for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
      std::vector<float> pdf(n), weight(channels * n), again(n), f(channels * n), one(channels), value(channels);
      m.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n}, mode);
      m.eval_pdf(wi.span(), wo.span(), {f.data(), n}, again.data());
      for (std::size_t i = 0; i < n; ++i) {
        const Sample s = m.sample(wo[i], u[i], one, mode);
        ASSERT_GT(s.pdf, 0) << i;
        ASSERT_EQ(s.flags & ~m.scatter_flags(), 0U);
        ASSERT_EQ((s.flags & sample_transmission) != 0, s.wi.z * wo.z[i] < 0);
        ASSERT_NEAR(s.pdf, pdf[i], 1e-4f * pdf[i]) << i;
        ASSERT_NEAR(std::hypot(s.wi.x - wi.x[i], s.wi.y - wi.y[i], s.wi.z - wi.z[i]), 0, 1e-6) << i;
        const float single = m.eval_pdf(wi[i], wo[i], value);
        for (std::size_t c = 0; c < channels; ++c) {
          ASSERT_NEAR(one[c], weight[c * n + i], 1e-4f * (one[c] + 1e-3f)) << i;
          if (delta)
            ASSERT_EQ(f[c * n + i], 0);
          else
            ASSERT_NEAR(f[c * n + i] * wi.z[i] / pdf[i], one[c], 1e-4f * one[c]) << i;
          ASSERT_NEAR(value[c], f[c * n + i], 2e-5f * value[c]) << i;
        }
        ASSERT_NEAR(again[i], delta ? 0 : pdf[i], 1e-4f * pdf[i]) << i;
        ASSERT_NEAR(single, again[i], 1e-5f * single) << i;
      }
    }
  }
}

// A white surface gives back no more than arrives, and a lossless one all of it.
TEST(AnalyticSampling, EnergyIsKept) {
  for (const test::NamedModel& named : test::all_models()) {
    const Material m = Material::from_analytic(named.model);
    std::vector<float> a(static_cast<std::size_t>(m.channels()));
    for (const double cosine : {1.0, 0.9, 0.5, 0.2, 0.05, 1e-3, 1e-6}) {
      m.albedo(test::direction_at(cosine, 0.4), a);
      for (const float v : a) {
        EXPECT_LE(v, 1 + 1e-3f) << named.name << " at " << cosine;
        EXPECT_GE(v, 0);
        if (named.name == "white" || std::holds_alternative<Dielectric>(named.model)) {
          EXPECT_NEAR(v, 1, 1e-3f) << named.name << " at " << cosine;
        }
      }
    }
    m.albedo(test::direction_at(0.5, 0.4), a);
    const auto* mirror = std::get_if<Mirror>(&named.model);
    const auto* diffuse = std::get_if<Lambert>(&named.model);
    if (mirror == nullptr && diffuse == nullptr) continue;
    const std::vector<float>& expected = mirror != nullptr ? mirror->reflectance : diffuse->albedo;
    for (std::size_t c = 0; c < a.size(); ++c) EXPECT_NEAR(a[c], expected[c], mirror != nullptr ? 0 : 1e-5f);
  }
}

TEST(AnalyticSampling, ReflectionIsReciprocalToTheLastBit) {
  const std::size_t n = 1000;
  const DirectionBatch wi = test::random_directions(n, 8), wo = test::random_directions(n, 9);
  for (const test::NamedModel& named : test::spread_models()) {
    const Material m = Material::from_analytic(named.model);
    EXPECT_TRUE(m.info().reciprocal);
    const std::size_t values = n * static_cast<std::size_t>(m.channels());
    std::vector<float> f(values), g(values);
    m.eval(wi.span(), wo.span(), {f.data(), n});
    m.eval(wo.span(), wi.span(), {g.data(), n});
    EXPECT_EQ(f, g) << named.name;
    EXPECT_GT(*std::max_element(f.begin(), f.end()), 0);
  }
}

// f cos_i of a transmission as a measure is T delta, times 1 / eta^2 for radiance. What goes one way with T comes back with
// the same T, and eta_there eta_back = 1: f(wi, wo) / n_i^2 is symmetric (Veach 1997, eq. 5.14).
TEST(AnalyticSampling, TransmissionComesBackTheSameWay) {
  for (const float ior : {1.5f, 0.75f, 4.0f, 1.0000001f}) {
    const Material m = Material::from_analytic(Dielectric{ior, 1});
    for (const double cosine : {1.0, 0.95, 0.8, 0.7}) {
      const Vec3f wo = test::direction_at(cosine, 0.3);
      for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
        float there = 0, back = 0;
        const Sample in = m.sample(wo, {0.9999999f, 0, 0}, {&there, 1}, mode);
        ASSERT_EQ(in.flags, sample_transmission | sample_delta) << ior << ' ' << cosine;
        const Sample out = m.sample(in.wi, {0.9999999f, 0, 0}, {&back, 1}, mode);
        ASSERT_EQ(out.flags, sample_transmission | sample_delta);
        EXPECT_NEAR(std::hypot(out.wi.x - wo.x, out.wi.y - wo.y, out.wi.z - wo.z), 0, 2e-6 * static_cast<double>(std::max(1.0f, ior)));
        EXPECT_NEAR(in.eta * out.eta, 1, 1e-6);
        EXPECT_NEAR(in.pdf, out.pdf, 1e-5);
        const float scale = mode == TransportMode::radiance ? in.eta * in.eta : 1.0f;
        EXPECT_NEAR(there * in.pdf * scale, back * out.pdf / scale, 1e-5) << ior << ' ' << cosine;
      }
    }
  }
}

// Reflection and transmission are chosen as often as their pdf says.
TEST(AnalyticSampling, DeltaLobesAreChosenByTheirProbability) {
  const Material m = Material::from_analytic(Dielectric{1.5f, 1});
  const std::size_t n = 200000;
  const DirectionBatch u = test::random_numbers(n, 12);
  for (const double cosine : {0.9, 0.3, 0.1}) {
    const Vec3f wo = test::direction_at(cosine, 1);
    std::size_t reflected = 0;
    float pdf = 0, weight = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Sample s = m.sample(wo, u[i], {&weight, 1});
      if ((s.flags & sample_reflection) != 0) ++reflected, pdf = s.pdf;
    }
    const double p = static_cast<double>(pdf), count = static_cast<double>(n);
    EXPECT_NEAR(static_cast<double>(reflected) / count, p, 4 * std::sqrt(p * (1 - p) / count)) << cosine;
  }
}

}  // namespace

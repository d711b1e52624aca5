// SPDX-License-Identifier: Apache-2.0
// The map from the unit square to directions: its inverse, its horizon, its area, and where samples join.
#include "sample/half_vector_map.h"
#include "support/direction_batch.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace {

using namespace brdf;
using Map = sample::HalfVectorMap<double>;

const double cosines[] = {1, 0.999, 0.7, 0.2, 0.01, 1.7e-3, 1e-5};

Map map_at(double c) { return Map(std::sqrt(1 - c * c), c); }

Vec3d reflected(const Map& m, const Map::Half& h) {
  return {2 * h.wo_h * h.x - m.s, 2 * h.wo_h * h.y, 2 * h.wo_h * h.z - m.c};
}

TEST(SampleMap, InverseReturnsThePoint) {
  for (const double c : cosines)
    for (const double height : {1e-11, 1e-4, 0.1, 0.5, 0.99, 1 - 1e-7})
      for (const double v : {0.001, 0.3, 0.4999, 0.5001, 0.8, 0.999}) {
        const Map m = map_at(c);
        const Map::Half h = m.half_vector(height, v);
        const Map::Point p = m.point(2 * h.wo_h * h.x, 2 * h.wo_h * h.y, 2 * h.wo_h * h.z);
        ASSERT_NEAR(p.height, height, 1e-8 * height);
        ASSERT_NEAR(p.v, v, 1e-8);
        ASSERT_NEAR(p.area, h.area, 1e-8 * h.area);
      }
}

TEST(SampleMap, TheEdgeOfTheSquareIsTheHorizon) {
  for (const double c : cosines)
    for (int k = 0; k <= 40; ++k) {
      const Map m = map_at(c);
      EXPECT_NEAR(reflected(m, m.half_vector(1, k / 40.0)).z, 0, 2e-15);
      EXPECT_GT(reflected(m, m.half_vector(1 - 1e-6, k / 40.0)).z, 0);
    }
}

TEST(SampleMap, AreasAddUpToTheHemisphere) {
  for (const double c : {1.0, 0.7, 0.2, 0.05}) {
    const Map m = map_at(c);
    const int n = 1500;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) sum += m.half_vector((i + 0.5) / n, (j + 0.5) / n).area;
    EXPECT_NEAR(2 * sum / (n * n), 2 * std::numbers::pi, 2e-3) << c;
  }
}

Vec3f drawn(const Material& m, const Vec3f& wo, float u, float v) {
  std::array<float, 3> weight{};
  return m.sample(wo, {0.9f, u, v}, weight).wi;
}

double distance(const Vec3f& a, const Vec3f& b) {
  return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y), static_cast<double>(a.z - b.z));
}

TEST(SampleMap, SamplesAreContinuousAcrossCellsAndSides) {
  const Material m = test::material_of(test::usual_lobes(), test::synthetic_grid({}));
  for (const double c : {0.95, 0.5, 0.1}) {
    const Vec3f wo = test::direction_at(c, 0.3);
    const float step = 0x1p-14f;
    for (const float fixed : {0.2f, 0.5f, 0.85f}) {
      for (float u = 0.01f; u < 0.99f; u += step) {
        ASSERT_LT(distance(drawn(m, wo, u, fixed), drawn(m, wo, u + step, fixed)), 0.02) << c << ' ' << u << ' ' << fixed;
        ASSERT_LT(distance(drawn(m, wo, fixed, u), drawn(m, wo, fixed, u + step)), 0.02) << c << ' ' << fixed << ' ' << u;
      }
    }
    EXPECT_LT(distance(drawn(m, wo, std::nextafter(0.5f, 0.0f), 0.4f), drawn(m, wo, 0.5f, 0.4f)), 1e-5);
    EXPECT_LT(distance(drawn(m, wo, 0, 0.4f), drawn(m, wo, std::nextafter(1.0f, 0.0f), 0.4f)), 1e-4);
  }
}

TEST(SampleMap, NarrowAndRetroLobesAgreeWithTheirPdf) {
  for (const double alpha : {1e-3, 0.03, 1.0})
    for (const bool retro : {false, true}) {
      const Material m = test::material_of({3, {test::lambert_lobe(3, 0.2), test::ggx_lobe(3, alpha, 0.7, 1, retro)}});
      const std::size_t n = 2000;
      const test::DirectionBatch u = test::random_numbers(n, 3), wo = test::random_directions(n, 4);
      test::on_every_target([&] {
        test::DirectionBatch wi(n);
        std::vector<float> pdf(n), again(n), weight(3 * n);
        m.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n});
        m.pdf(wi.span(), wo.span(), again.data());
        for (std::size_t i = 0; i < n; ++i) {
          // A direction is rounded by some 1e-7, which turns the half vector by as much over the length of wi + wo, and its
          // azimuth by more: over the lobe's width; the horizon's height over the azimuth changes within the cosines.
          const double sum = static_cast<double>(wi.z[i] + wo.z[i]);
          const double bound = 1e-4 + 1e-6 / static_cast<double>(wi.z[i]) + 1e-6 / (sum * alpha) + 1.2e-7 / (sum * sum * alpha);
          ASSERT_NEAR(pdf[i] / again[i], 1, bound) << alpha << retro << ' ' << wo.z[i] << ' ' << wi.z[i];
          const float single = m.pdf(wi[i], wo[i]);
          ASSERT_NEAR(again[i] / single, 1, bound) << alpha << retro;
        }
      });
    }
}

}  // namespace

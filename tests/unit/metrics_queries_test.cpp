// SPDX-License-Identifier: Apache-2.0
// The fixed directions: what their weights integrate to, and what they look like.
#include "metrics/queries.h"

#include "metrics/half_vector_density.h"
#include "metrics/low_discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace {

using namespace brdf;
using namespace brdf::metrics;
constexpr double pi = std::numbers::pi;

const QuerySet& full_set() {
  static const QuerySet set = build_queries(1.0);
  return set;
}

TEST(Sobol, StratifiesEveryDimensionAndPlane) {
  const Sobol sobol(3);
  constexpr std::uint32_t n = 1024;
  for (std::size_t d = 0; d < 4; ++d) {
    std::set<int> cells;
    for (std::uint32_t i = 0; i < n; ++i) cells.insert(static_cast<int>(sobol(i)[d] * n));
    EXPECT_EQ(cells.size(), n) << "dimension " << d;
  }
  // dimensions 1 and 2 form a (0, m, 2)-net: one point in every elementary interval, here of 32 x 32
  std::set<int> cells;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto p = sobol(i);
    cells.insert(static_cast<int>(p[0] * 32) * 32 + static_cast<int>(p[1] * 32));
  }
  EXPECT_EQ(cells.size(), n);
}

TEST(Sobol, IntegratesAProductOfFourDimensions) {
  const Sobol sobol(1);
  constexpr std::uint32_t n = 1u << 14;
  double sum = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto p = sobol(i);
    sum += 16 * p[0] * p[1] * p[2] * p[3];
  }
  EXPECT_NEAR(sum / n, 1, 2e-3);
}

TEST(HalfVectorDensity, IntegratesToOneOverTheSphereOfReflections) {
  const Vec3d wo = glm::normalize(Vec3d{0.6, 0, 0.8});
  // integral over h of p_h = 4 (wo.h) times the reflected density, over the part of the hemisphere with wo.h > 0
  double total = 0;
  constexpr int n = 800;
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      const double u = (a + 0.5) / n, v = (b + 0.5) / n;
      const Vec3d h = half_vector(u, v), wi = reflect_about(wo, h);
      const double theta = 0.5 * pi * u * u, jacobian = pi * u * 2 * pi * std::sin(theta);  // d omega_h / (du dv)
      const double d = glm::dot(wo, h);
      if (d > 1e-3) total += reflected_density(wi, wo) * 4 * d * jacobian / (n * n);
    }
  }
  double expected = 0;  // share of the half vectors on wo's side
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      expected += glm::dot(wo, half_vector((a + 0.5) / n, (b + 0.5) / n)) > 1e-3 ? 1.0 / (n * n) : 0.0;
  EXPECT_NEAR(total, expected, 1e-3);
}

TEST(Queries, AllDirectionsAreUnitVectorsAboveTheHorizon) {
  const QuerySet& set = full_set();
  ASSERT_EQ(set.wi.size(), set.wo.size());
  for (std::size_t i = 0; i < set.rows(); ++i) {
    for (const Vec3f& w : {set.wi[i], set.wo[i]}) {
      ASSERT_GT(w.z, 0) << i;
      ASSERT_NEAR(glm::dot(Vec3d(w), Vec3d(w)), 1, 3e-7) << i;
    }
  }
}

TEST(Queries, ImagesHaveTheDefinedPixels) {
  const QuerySet& set = full_set();
  std::uint32_t disc = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const double u = (x + 0.5) / 32 - 1, v = 1 - (y + 0.5) / 32;
      disc += u * u + v * v < 0.98;
    }
  EXPECT_EQ(set.image[0].pixels, disc);
  EXPECT_EQ(set.image[1].pixels, disc);  // the light behind the viewer reaches every pixel
  EXPECT_LT(set.image[3].pixels, disc / 2);
  EXPECT_EQ(set.radiance.size(), 600u);
  std::size_t at = 0;
  for (const ImageRows& image : set.image) {
    EXPECT_EQ(image.first, at);
    for (std::size_t r = image.first; r < image.first + image.rows; ++r) ASSERT_LT(set.pixel[r], image.pixels);
    at += image.rows;
  }
  EXPECT_EQ(at, set.first_pair);
}

TEST(Queries, EnvironmentLightsAddUpToTheSphere) {
  // A white Lambertian sphere under a constant environment shows the radiance times the visible share of the sky.
  const QuerySet& set = full_set();
  std::vector<double> irradiance(set.image[0].pixels);
  for (std::size_t r = 0; r < set.image[0].rows; ++r)
    irradiance[set.pixel[r]] += static_cast<double>(set.wi[r].z) * 4 * pi / 600;
  for (const double e : irradiance) ASSERT_NEAR(e, pi, 0.02 * pi);
}

TEST(Queries, GainUsesRgbForThreeChannelsAndItsMeanOtherwise) {
  const QuerySet& set = full_set();
  const std::size_t row = 12345;
  const double cos_i = static_cast<double>(set.wi[row].z);
  const Vec3d& light = set.radiance[set.light[row]];
  for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(set.gain(row, c, 3), cos_i * light[c]);
  EXPECT_DOUBLE_EQ(set.gain(row, 0, 1), cos_i * (light.x + light.y + light.z) / 3);
  const std::size_t lit = set.image[2].first;
  EXPECT_DOUBLE_EQ(set.gain(lit, 1, 3), static_cast<double>(set.wi[lit].z));
}

TEST(Queries, PairWeightsIntegrateOverTwoHemispheres) {
  const QuerySet& set = full_set();
  double total = 0, cos_i = 0, below = 0, cos_below = 0, product = 0;
  for (std::size_t i = 0; i < set.pairs; ++i) {
    const double w = set.pair_weight[i], zi = static_cast<double>(set.wi[set.first_pair + i].z);
    const double zo = static_cast<double>(set.wo[set.first_pair + i].z);
    total += w;
    cos_i += w * zi;
    product += w * zi * zo;
    if (set.pair_band[i] > last_headline_band) continue;
    below += w;
    cos_below += w * zi;
  }
  // 131072 candidates of either strategy; wi is uniform, hence the factor 2 pi of its own
  EXPECT_NEAR(total / 131072 * 2 * pi, 4 * pi * pi, 0.002 * 4 * pi * pi);
  EXPECT_NEAR(cos_i / total, 0.5, 1e-3);
  EXPECT_NEAR(product / total, 0.25, 1e-3);
  const double c85 = std::cos(85 * pi / 180);
  EXPECT_NEAR(below / total, (1 - c85) * (1 - c85), 2e-3);
  EXPECT_NEAR(cos_below / below, 0.5 * (1 + c85), 1e-3);  // cos is uniform above cos 85 degrees
}

TEST(Queries, PairsReachNarrowLobes) {
  // Mean of a function of the half vector alone that lives within about a degree of the normal.
  const QuerySet& set = full_set();
  const auto peak = [](double theta) { return std::exp(-theta * theta / (2 * 0.01 * 0.01)); };
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < set.pairs; ++i) {
    const Vec3d h = glm::normalize(Vec3d(set.wi[set.first_pair + i]) + Vec3d(set.wo[set.first_pair + i]));
    sum += set.pair_weight[i] * peak(std::atan2(std::hypot(h.x, h.y), h.z));
    total += set.pair_weight[i];
  }
  // near the normal wo is wi turned by pi: integral over h of 4 (wi.h), averaged over wi: 4 * 1/2 / (2 pi)
  EXPECT_NEAR(sum / total, 2 / (2 * pi) * 2 * pi * 0.01 * 0.01, 0.02 * 2e-4);
}

TEST(Queries, BandsFollowTheLargerAngle) {
  const QuerySet& set = full_set();
  for (std::size_t i = 0; i < set.pairs; ++i) {
    const float low = std::min(set.wi[set.first_pair + i].z, set.wo[set.first_pair + i].z);
    const double degrees = std::acos(static_cast<double>(low)) * 180 / pi;
    const double begin = set.pair_band[i] == 0 ? 0 : band_ends[set.pair_band[i] - 1u];
    ASSERT_GE(degrees, begin - 1e-9);
    ASSERT_LE(degrees, band_ends[set.pair_band[i]] + 1e-9);
  }
}

TEST(Queries, AlbedoQuadratureIsExactForLambertAndCosinePowers) {
  const QuerySet& set = full_set();
  for (std::size_t k = 0; k < albedo_cosines.size(); ++k) {
    double lambert = 0, square = 0;
    for (std::size_t r = set.albedo_begin[k]; r < set.albedo_begin[k + 1]; ++r) {
      const double w = set.albedo_weight[r - set.albedo_begin[0]], z = static_cast<double>(set.wi[r].z);
      lambert += w / pi;
      square += w * z * z;
      EXPECT_FLOAT_EQ(set.wo[r].z, static_cast<float>(albedo_cosines[k]));
    }
    EXPECT_NEAR(lambert, 1, 2e-3);
    EXPECT_NEAR(square, 2 * pi / 4, 4e-3);  // 2 pi integral of c^3
  }
}

TEST(Queries, QualityScalesTheNumberOfRows) {
  const auto full = static_cast<double>(full_set().rows());
  EXPECT_NEAR(static_cast<double>(build_queries(0.1).rows()), 0.1 * full, 0.02 * full);
  EXPECT_NEAR(static_cast<double>(build_queries(0.5).rows()), 0.5 * full, 0.03 * full);
  EXPECT_GT(build_queries(1e-6).pairs, 100u);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// EnergyMode::clamp keeps its promise on the finished file, and report leaves the file alone.
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf {
namespace {

/// Bright and brighter towards the horizon, measured only where nothing grazes: what a fit continues gives back too much.
Measurement bright_where_measured() {
  Measurement m = test::small_measurement({36, 18, 24}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
    for (std::size_t c = 0; c < f.size(); ++c) f[c] = (0.36 - 0.04 * static_cast<double>(c)) / std::pow((wi.z + wo.z) / 2, 1.2);
  });
  auto& table = std::get<HalfDifferenceTable>(m.table);
  std::size_t cell = 0;
  for (int i = 0; i < table.n_theta_h; ++i)
    for (int j = 0; j < table.n_theta_d; ++j)
      for (int k = 0; k < table.n_phi_d; ++k, ++cell) {
        const double u = static_cast<double>(i) / table.n_theta_h, pi = std::numbers::pi;
        Vec3d wi, wo;
        geometry::directions_from_half_difference(u * u * pi / 2, j * pi / 2 / table.n_theta_d, k * pi / table.n_phi_d, wi, wo);
        if (std::min(wi.z, wo.z) < 0.5) table.valid[cell] = 0;
      }
  return m;
}

double largest_albedo(const Material& whole, EvalLevel level) {
  const Material m = whole.prepare(level);
  float largest = 0;
  std::vector<float> a(static_cast<std::size_t>(m.channels()));
  for (int degrees = 0; degrees <= 85; degrees += 5) {
    const double theta = degrees * std::numbers::pi / 180;
    m.albedo(Vec3f(Vec3d(std::sin(theta), 0, std::cos(theta))), a);
    largest = std::max(largest, *std::max_element(a.begin(), a.end()));
  }
  return static_cast<double>(largest);
}

TEST(EncodeEnergy, ClampKeepsAlbedosBelowWhatArrives) {
  const Measurement m = bright_where_measured();
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 300;
  const EncodeResult reported = compress(m, options);
  const double limit = std::max(1.0, reported.summary.source_albedo) + 0.005;
  ASSERT_GT(reported.summary.largest_albedo, limit) << "otherwise there is nothing to clamp";
  EXPECT_EQ(reported.summary.energy_scale, 1);
  EXPECT_NE(reported.summary.energy.find("--energy clamp"), std::string::npos);
  options.energy = EnergyMode::clamp;
  const EncodeResult clamped = compress(m, options);
  EXPECT_LE(clamped.bytes.size(), 300U);
  EXPECT_LT(clamped.summary.energy_scale, 1);
  EXPECT_GT(clamped.summary.energy_scale, 0.8 * limit / reported.summary.largest_albedo);
  EXPECT_LE(clamped.summary.largest_albedo, limit);
  const Material material = Material::decode(clamped.bytes);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact})
    EXPECT_LE(largest_albedo(material, level), limit + 0.002) << to_string(level);
}

TEST(EncodeEnergy, ClampLeavesDarkMaterialsAlone) {
  const Measurement m = test::bumpy_measurement();
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 300;
  const EncodeResult reported = compress(m, options);
  ASSERT_LT(reported.summary.largest_albedo, 1);
  options.energy = EnergyMode::clamp;
  EXPECT_EQ(compress(m, options).bytes, reported.bytes);
}

}  // namespace
}  // namespace brdf

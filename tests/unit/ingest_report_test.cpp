// SPDX-License-Identifier: Apache-2.0
// The report on a measurement, for materials whose figures are known.
#include <brdf/ingest.h>

#include "support/tensor_file_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace brdf {
namespace {

constexpr double pi = std::numbers::pi;

Measurement lambert(double albedo) {
  HalfDifferenceTable t;
  t.n_theta_h = t.n_theta_d = 90;
  t.n_phi_d = 180;
  t.values.assign(std::size_t{3} * 90 * 90 * 180, static_cast<float>(albedo / pi));
  t.valid.assign(t.values.size() / 3, 1);
  Measurement m;
  m.table = std::move(t);
  return m;
}

/// RGL material with f cos(theta_o) = 0.2 everywhere.
test::TensorFileBuilder constant_times_cosine() {
  auto file = test::small_rgl_material();
  file.set_floats("rgb", {1, 2, 3, 3, 3}, std::vector<float>(54, 0.2f));
  return file;
}

TEST(IngestReport, LambertIsReciprocalAndHasItsAlbedo) {
  const IngestReport r = report(lambert(0.8));
  EXPECT_EQ(r.cells, 1458000u);
  EXPECT_EQ(r.numbers, 4374000u);
  EXPECT_EQ(r.invalid_fraction, 0);
  EXPECT_EQ(r.negative_fraction, 0);
  EXPECT_EQ(r.reciprocity_asymmetry, 0);
  EXPECT_NEAR(r.mirror_asymmetry, 0, 1e-12);
  EXPECT_NEAR(r.max_albedo, 0.8, 0.004);
  EXPECT_NEAR(r.max_value, 0.8 / pi, 1e-6);
}

TEST(IngestReport, MaskedCellsAreCountedAndTheirValuesIgnored) {
  Measurement m = lambert(0.5);
  auto& t = std::get<HalfDifferenceTable>(m.table);
  for (std::size_t cell = 0; cell < t.valid.size(); cell += 4) {
    t.valid[cell] = 0;
    t.values[3 * cell] = 1e6f;
  }
  const IngestReport r = report(m);
  EXPECT_NEAR(r.invalid_fraction, 0.25, 1e-9);
  EXPECT_NEAR(r.max_value, 0.5 / pi, 1e-6);
  EXPECT_NEAR(r.max_albedo, 0.5, 0.004);
}

TEST(IngestReport, ANarrowPeakIsNotMissed) {
  // f = 1000 where theta_h lies in bins 0 to 4 (below 0.28 degrees): found in the maximum
  Measurement m = lambert(0.5);
  auto& t = std::get<HalfDifferenceTable>(m.table);
  for (std::size_t k = 0; k < std::size_t{5} * 90 * 180 * 3; ++k) t.values[k] = 1000;
  const IngestReport r = report(m);
  EXPECT_NEAR(r.max_value, 1000, 1e-6);
  // at normal incidence the peak adds integral 1000 cos(theta_i) dwi with theta_i = 2 theta_h; f falls to 0 linearly in
  // the bin coordinate from bin 4 to 5
  double peak = 0;
  for (int n = 0; n < 200000; ++n) {
    const double x = 5 * (n + 0.5) / 200000, theta = 2 * (x / 90) * (x / 90) * pi / 2;
    const double next = 2 * std::pow((x + 5e-6) / 90, 2) * pi / 2, before = 2 * std::pow((x - 5e-6) / 90, 2) * pi / 2;
    const double f = x < 4 ? 1000 : 1000 + (x - 4) * (0.5 / pi - 1000);
    peak += 2 * pi * std::sin(theta) * std::cos(theta) * (f - 0.5 / pi) * (next - before) / 1e-5 * (5.0 / 200000);
  }
  EXPECT_NEAR(r.max_albedo, 0.5 + peak, 0.03 * (0.5 + peak));
}

TEST(IngestReport, NonReciprocityIsMeasured) {
  const Measurement m = read_measurement(constant_times_cosine().build(), "m.bsdf");
  const IngestReport r = report(m);
  // |log(1 + 0.2 cos_i / cos_o) - log(1 + 0.2)| over independent cosines uniform in (cos 85, 1)
  std::mt19937 random(1);
  std::uniform_real_distribution<double> cosine(std::cos(85 * pi / 180), 1);
  double expected = 0;
  constexpr int count = 1000000;
  for (int n = 0; n < count; ++n) {
    const double cos_i = cosine(random), cos_o = cosine(random);
    expected += std::abs(std::log1p(0.2 * cos_i / cos_o) - std::log1p(0.2)) / count;
  }
  EXPECT_NEAR(r.reciprocity_asymmetry, expected, 0.015 * expected);
  EXPECT_EQ(r.cells, 18u);
  EXPECT_EQ(r.numbers, 54u);
  EXPECT_NEAR(r.mirror_asymmetry, 0, 1e-9);
  // f = 0.2 / cos_o, at most at 85 degrees; albedo = 0.2 pi / cos_o there
  EXPECT_NEAR(r.max_value, 0.2 / std::cos(85 * pi / 180), 0.02);
  EXPECT_NEAR(r.max_albedo, 0.2 * pi / std::cos(85 * pi / 180), 0.05);
}

TEST(IngestReport, MirrorAsymmetryIsMeasured) {
  auto file = constant_times_cosine();
  std::vector<float> values(54, 0.2f);
  for (std::size_t k = 0; k < 54; k += 9) values[k] = values[k + 1] = values[k + 2] = 0.9f;  // row 0: phi = -pi
  file.set_floats("rgb", {1, 2, 3, 3, 3}, values);
  const IngestReport r = report(read_measurement(file.build(), "m.bsdf"));
  EXPECT_GT(r.mirror_asymmetry, 0.05);
}

TEST(IngestReport, NegativeValuesAreCounted) {
  auto file = constant_times_cosine();
  std::vector<float> values(54, 0.2f);
  for (std::size_t k = 0; k < 27; ++k) values[2 * k] = -0.1f;
  file.set_floats("rgb", {1, 2, 3, 3, 3}, values);
  EXPECT_EQ(report(read_measurement(file.build(), "m.bsdf")).negative_fraction, 0.5);
}

TEST(IngestReport, IsTheSameEveryTime) {
  const Measurement m = read_measurement(test::small_rgl_material().build(), "m.bsdf");
  const IngestReport a = report(m), b = report(m);
  EXPECT_EQ(a.reciprocity_asymmetry, b.reciprocity_asymmetry);
  EXPECT_EQ(a.max_albedo, b.max_albedo);
}

}  // namespace
}  // namespace brdf

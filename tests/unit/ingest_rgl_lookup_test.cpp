// SPDX-License-Identifier: Apache-2.0
// Interpolation in RGL tables, against values computed by hand from the format's maps:
// u = sqrt(2 theta_h / pi), v = (phi_h - phi_i + pi) / 2 pi, f cos(theta_o) = values(s) [* ndf / (4 sigma)].
#include <brdf/ingest.h>

#include "support/tensor_file_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace brdf {
namespace {

constexpr double pi = std::numbers::pi;

Vec3d direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// wi and wo such that the half vector has that angle and azimuth relative to wi.
struct Pair {
  Vec3d wi, wo;
};
Pair pair_at(double theta_i, double theta_h, double phi_h, double turn = 0.3) {
  const Vec3d wi = direction(theta_i, turn), h = direction(theta_h, turn + phi_h);
  const double d = wi.x * h.x + wi.y * h.y + wi.z * h.z;
  return {wi, 2 * d * h - wi};
}

Measurement read(const test::TensorFileBuilder& file) { return read_measurement(file.build(), "m_rgb.bsdf"); }

/// f cos(theta_o) of the first two channels.
std::array<double, 2> eval_cosine(const Measurement& m, const Pair& p) {
  std::array<double, 3> f{};
  EXPECT_TRUE(MeasurementInterpolator(m).eval(p.wi, p.wo, f));
  return {f[0] * p.wo.z, f[1] * p.wo.z};
}

TEST(RglLookup, UniformDensityReadsTheTableAtUAndV) {
  const Measurement m = read(test::small_rgl_material());
  // theta_h = pi / 8: u = 1/2, column 1; phi = pi / 2: v = 3/4, row 1.5; theta_i = 0: first elevation.
  // At theta_i = 0 the azimuth of wi counts as 0.
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 8, pi / 2, 0))[0], 15 + 1, 1e-5);
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 8, pi / 2, 0))[1], 15 + 1 + 0.1, 1e-5);
  // theta_h = pi / 32: u = 1/4, column 0.5; phi = 0: v = 1/2, row 1
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 32, 0, 0))[0], 10.5, 1e-5);
}

TEST(RglLookup, ElevationsAreInterpolatedLinearlyAndClamped) {
  const Measurement m = read(test::small_rgl_material());
  for (const double theta_i : {pi / 12, pi / 6, pi / 4, pi / 3}) {
    const double share = theta_i / (pi / 3);
    EXPECT_NEAR(eval_cosine(m, pair_at(theta_i, pi / 32, 0))[0], 100 * share + 10.5, 1e-4) << theta_i;
  }
  // beyond the last elevation; phi = 3 pi / 4: v = 7/8, row 1.75
  EXPECT_NEAR(eval_cosine(m, pair_at(1.3, pi / 32, 3 * pi / 4))[0], 100 + 17.5 + 0.5, 1e-4);
}

TEST(RglLookup, AzimuthCountsFromTheLightAndDirectionsMayTurn) {
  const Measurement m = read(test::small_rgl_material());
  for (const double turn : {0.0, 1.0, 3.1, -2.5}) {
    // phi = -pi / 4: v = 3/8, row 0.75
    EXPECT_NEAR(eval_cosine(m, pair_at(pi / 6, pi / 32, -pi / 4, turn))[0], 50 + 7.5 + 0.5, 1e-4) << turn;
  }
}

TEST(RglLookup, TheVisibleNormalDensityWarpsTheTable) {
  auto file = test::small_rgl_material();
  file.set_floats("vndf", {1, 2, 2, 2}, {0, 1, 0, 1, 0, 1, 0, 1});  // 2 u: s.u = u^2
  const Measurement m = read(file);
  // u = 1/2: s.u = 1/4, column 0.5
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 8, 0, 0))[0], 10.5, 1e-5);
}

TEST(RglLookup, DensitiesOfNeighbouringElevationsAreBlended) {
  auto file = test::small_rgl_material();
  file.set_floats("vndf", {1, 2, 2, 2}, {1, 1, 1, 1, 0, 1, 0, 1});
  const Measurement m = read(file);
  // half way: s.u = u / 2 + u^2 / 2 = 3/8 at u = 1/2, column 0.75
  EXPECT_NEAR(eval_cosine(m, pair_at(pi / 6, pi / 8, 0))[0], 50 + 10 + 0.75, 1e-4);
}

TEST(RglLookup, JacobianMultipliesByNdfOverFourSigma) {
  auto file = test::small_rgl_material();
  file.field("jacobian").data = {std::byte{1}};
  file.set_floats("ndf", {2, 2}, {8, 16, 8, 16});      // along u: 12 at u = 1/2
  file.set_floats("sigma", {2, 2}, {0.5, 1, 0.5, 1});  // along u_i = sqrt(2 theta_i / pi)
  const Measurement m = read(file);
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 8, 0, 0))[0], 11 * 12 / (4 * 0.5), 1e-4);
  // theta_i = pi / 8: u_i = 1/2, sigma = 3/4, elevation share 3/8
  EXPECT_NEAR(eval_cosine(m, pair_at(pi / 8, pi / 8, 0))[0], (37.5 + 11) * 12 / (4 * 0.75), 1e-3);
}

TEST(RglLookup, SigmaMayDependOnTheAzimuthOfTheLight) {
  auto file = test::small_rgl_material();
  file.field("jacobian").data = {std::byte{1}};
  file.set_floats("sigma", {2, 2}, {1, 1, 2, 2});  // 1 at phi_i = -pi, 2 at pi
  const Measurement m = read(file);
  // phi_i = pi / 2: v = 3/4, sigma = 1.75
  EXPECT_NEAR(eval_cosine(m, pair_at(pi / 6, pi / 32, 0, pi / 2))[0], 60.5 / (4 * 1.75), 1e-4);
}

TEST(RglLookup, NegativeValuesAreClippedAfterInterpolationOnly) {
  auto file = test::small_rgl_material();
  std::vector<float> values(54, 3.0f);
  for (std::size_t k = 0; k < 54; k += 3) values[k] = -1.0f;  // column 0
  file.set_floats("rgb", {1, 2, 3, 3, 3}, values);
  const Measurement m = read(file);
  EXPECT_NEAR(eval_cosine(m, pair_at(0, pi / 32, 0, 0))[0], 1, 1e-5);  // half way between -1 and 3
  EXPECT_EQ(eval_cosine(m, pair_at(0, pi / 2 * 0.01, 0, 0))[0], 0);    // u = 0.1, column 0.2: -0.2
}

TEST(RglLookup, AConstantTableGivesConstantFCosine) {
  auto file = test::small_rgl_material();
  file.set_floats("vndf", {1, 2, 2, 2}, {1, 2, 3, 4, 4, 3, 2, 1});
  file.set_floats("rgb", {1, 2, 3, 3, 3}, std::vector<float>(54, 0.25f));
  const Measurement m = read(file);
  const MeasurementInterpolator interpolator(m);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 20000; ++n) {
    const Vec3d wi = direction(std::acos(1 - 0.999 * u(random)), 2 * pi * u(random));
    const Vec3d wo = direction(std::acos(1 - 0.999 * u(random)), 2 * pi * u(random));
    std::array<double, 3> f{};
    ASSERT_TRUE(interpolator.eval(wi, wo, f));
    for (const double v : f) ASSERT_NEAR(v * wo.z, 0.25, 1e-9);
  }
}

TEST(RglLookup, ASingleElevationServesAllAngles) {
  auto file = test::small_rgl_material();
  file.set_floats("theta_i", {1}, {0.5f});
  file.set_floats("vndf", {1, 1, 2, 2}, std::vector<float>(4, 1.0f));
  file.set_floats("rgb", {1, 1, 3, 3, 3}, std::vector<float>(27, 2.0f));
  const Measurement m = read(file);
  EXPECT_NEAR(eval_cosine(m, pair_at(0.1, pi / 32, 0))[0], 2, 1e-6);
  EXPECT_NEAR(eval_cosine(m, pair_at(1.2, pi / 32, pi))[0], 2, 1e-6);
}

TEST(RglLookup, NothingBelowTheHorizon) {
  const Measurement m = read(test::small_rgl_material());
  std::array<double, 3> f = {7, 7, 7};
  EXPECT_FALSE(MeasurementInterpolator(m).eval({0, 0, 1}, {0.6, 0, -0.8}, f));
  EXPECT_EQ(f, (std::array<double, 3>{0, 0, 0}));
  EXPECT_FALSE(MeasurementInterpolator(m).eval({1, 0, 0}, {0, 0, 1}, f));
}

TEST(RglLookup, HostileDirectionsStayInsideTheTables) {
  auto file = test::small_rgl_material();
  file.field("jacobian").data = {std::byte{1}};
  const Measurement m = read(file);
  const MeasurementInterpolator interpolator(m);
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  std::array<double, 3> f{};
  EXPECT_FALSE(interpolator.eval({nan, nan, nan}, {0, 0, 1}, f));
  for (const double bad : {nan, infinite, -infinite, 1e300, 1e-320}) {
    for (const Vec3d& w : {Vec3d{bad, 0, 1}, Vec3d{0, bad, 1}, Vec3d{bad, bad, 1}, Vec3d{0, 0, std::abs(bad)}}) {
      interpolator.eval(w, {0, 0, 1}, f);
      interpolator.eval({0, 0.6, 0.8}, w, f);
      interpolator.eval(w, w, f);
    }
  }
}

TEST(RglLookup, TablesWhoseSizesDisagreeAreRefused) {
  Measurement m = read(test::small_rgl_material());
  std::get<VisibleNormalTable>(m.table).ndf.pop_back();
  EXPECT_THROW(MeasurementInterpolator{m}, std::runtime_error);
  m = read(test::small_rgl_material());
  std::get<VisibleNormalTable>(m.table).theta_i = {1, 1};
  EXPECT_THROW(MeasurementInterpolator{m}, std::runtime_error);
}

}  // namespace
}  // namespace brdf

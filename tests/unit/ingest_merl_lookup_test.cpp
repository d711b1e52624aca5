// SPDX-License-Identifier: Apache-2.0
// Interpolation in half/difference tables, against positions computed by hand.
#include <brdf/measurement.h>

#include "geometry/half_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace brdf {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// 90 x 90 x n_phi with value(i, j, k) in all channels, every cell valid.
template <class Value>
Measurement make_table(int n_phi, Value&& value) {
  HalfDifferenceTable t;
  t.n_theta_h = t.n_theta_d = 90;
  t.n_phi_d = n_phi;
  t.full_circle = n_phi == 360;
  for (int i = 0; i < 90; ++i) {
    for (int j = 0; j < 90; ++j) {
      for (int k = 0; k < n_phi; ++k) t.values.insert(t.values.end(), 3, static_cast<float>(value(i, j, k)));
    }
  }
  t.valid.assign(t.values.size() / 3, 1);
  Measurement m;
  m.table = std::move(t);
  return m;
}

HalfDifferenceTable& table_of(Measurement& m) { return std::get<HalfDifferenceTable>(m.table); }

struct Answer {
  bool exists;
  std::array<double, 3> f;
};

Answer eval(const Measurement& m, const Vec3d& wi, const Vec3d& wo) {
  Answer a{};
  a.exists = MeasurementInterpolator(m).eval(wi, wo, a.f);
  return a;
}

Answer eval_at(const Measurement& m, double theta_h, double theta_d, double phi_d) {
  Vec3d wi, wo;
  geometry::directions_from_half_difference(theta_h * degree, theta_d * degree, phi_d * degree, wi, wo);
  return eval(m, wi, wo);
}

Vec3d random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0, 1);
  const double z = 0.001 + 0.999 * u(random), phi = 2 * std::numbers::pi * u(random), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(MerlLookup, TheFirstBinsOfThetaHAreResolved) {
  const Measurement m = make_table(180, [](int i, int, int) { return i; });
  // bin i starts at (i / 90)^2 * 90 degrees: bin 1 at 0.0111, bin 2 at 0.0444
  EXPECT_NEAR(eval_at(m, 90.0 / 8100, 10, 40).f[0], 1, 1e-6);
  EXPECT_NEAR(eval_at(m, 90 * 0.25 / 8100, 10, 40).f[0], 0.5, 1e-6);
  EXPECT_NEAR(eval_at(m, 90 * 2.25 / 8100, 30, 100).f[1], 1.5, 1e-6);
  EXPECT_NEAR(eval_at(m, 90 * 1e-4 / 8100, 30, 100).f[1], 0.01, 1e-5);
  EXPECT_NEAR(eval_at(m, 90 * 0.25, 30, 100).f[2], 45, 1e-6);
}

TEST(MerlLookup, ThetaDIsLinearInDegreesAndClampedAtTheEnd) {
  const Measurement m = make_table(180, [](int, int j, int) { return j; });
  for (const double theta_d : {0.0, 1e-4, 0.5, 1.0, 45.25, 88.9}) {
    EXPECT_NEAR(eval_at(m, 0.5, theta_d, 90).f[0], theta_d, 1e-6) << theta_d;
  }
  EXPECT_NEAR(eval_at(m, 0.1, 89.5, 90).f[0], 89, 1e-6);
}

TEST(MerlLookup, PhiDWrapsAround) {
  const Measurement half = make_table(180, [](int, int, int k) { return k; });
  const Measurement full = make_table(360, [](int, int, int k) { return k; });
  EXPECT_NEAR(eval_at(full, 10, 20, 37.25).f[0], 37.25, 1e-6);
  EXPECT_NEAR(eval_at(full, 10, 20, 200).f[0], 200, 1e-6);
  EXPECT_NEAR(eval_at(full, 10, 20, 359.5).f[0], (359 + 0) / 2.0, 1e-5);
  EXPECT_NEAR(eval_at(half, 10, 20, 37.25).f[0], 37.25, 1e-6);
  EXPECT_NEAR(eval_at(half, 10, 20, 179.5).f[0], (179 + 0) / 2.0, 1e-5);
  EXPECT_NEAR(eval_at(half, 10, 20, 200).f[0], 20, 1e-6);   // by reciprocity phi_d - 180
  EXPECT_NEAR(eval_at(half, 10, 20, -30).f[0], 150, 1e-6);  // and phi_d + 180
}

TEST(MerlLookup, CentrePositionShiftsByHalfABin) {
  Measurement m = make_table(360, [](int, int, int k) { return k; });
  table_of(m).position = SamplePosition::centre;
  EXPECT_NEAR(eval_at(m, 10, 20, 37.25).f[0], 36.75, 1e-6);
  EXPECT_NEAR(eval_at(m, 10, 20, 0.25).f[0], 0.75 * 0 + 0.25 * 359, 1e-5);
  Measurement along_d = make_table(180, [](int, int j, int) { return j; });
  table_of(along_d).position = SamplePosition::centre;
  EXPECT_NEAR(eval_at(along_d, 10, 20, 37).f[0], 19.5, 1e-6);
  EXPECT_NEAR(eval_at(along_d, 10, 0.25, 37).f[0], 0, 1e-6);  // clamped to the first sample
}

TEST(MerlLookup, MaskedCornersAreLeftOutAndTheOthersRenormalised) {
  Measurement m = make_table(180, [](int, int j, int) { return j; });
  HalfDifferenceTable& t = table_of(m);
  for (std::size_t cell = 0; cell < t.valid.size(); ++cell) {
    const std::size_t j = cell / 180 % 90;
    if (j == 20) t.valid[cell] = 0;
    if (j == 20) t.values[3 * cell] = std::nanf("");
  }
  EXPECT_NEAR(eval_at(m, 10, 20.5, 40).f[0], 21, 1e-6);
  EXPECT_NEAR(eval_at(m, 10, 19.75, 40).f[0], 19, 1e-6);
  EXPECT_TRUE(eval_at(m, 10, 20.5, 40).exists);
}

TEST(MerlLookup, WithoutAValidCornerThereIsNoValue) {
  Measurement m = make_table(180, [](int, int, int) { return 5; });
  HalfDifferenceTable& t = table_of(m);
  for (std::size_t cell = 0; cell < t.valid.size(); ++cell) {
    const std::size_t j = cell / 180 % 90;
    if (j == 20 || j == 21) t.valid[cell] = 0;
  }
  const Answer a = eval_at(m, 10, 20.5, 40);
  EXPECT_FALSE(a.exists);
  EXPECT_EQ(a.f, (std::array<double, 3>{0, 0, 0}));
  EXPECT_TRUE(eval_at(m, 10, 22.5, 40).exists);
}

TEST(MerlLookup, NegativeValuesAreClippedAfterInterpolation) {
  const Measurement m = make_table(180, [](int, int j, int) { return j == 20 ? -1 : 3; });
  EXPECT_NEAR(eval_at(m, 10, 20.5, 40).f[0], 1, 1e-6);
  EXPECT_EQ(eval_at(m, 10, 20.125, 40).f[0], 0);
}

TEST(MerlLookup, AConstantTableIsConstantEverywhereAboveTheHorizon) {
  const Measurement m = make_table(180, [](int, int, int) { return 0.25; });
  const MeasurementInterpolator interpolator(m);
  std::mt19937 random(1);
  for (int n = 0; n < 20000; ++n) {
    std::array<double, 3> f{};
    ASSERT_TRUE(interpolator.eval(random_direction(random), random_direction(random), f));
    for (const double v : f) ASSERT_NEAR(v, 0.25, 1e-12);
  }
}

TEST(MerlLookup, HalfACircleIsReciprocalToTheLastBit) {
  std::mt19937 noise(2), random(3);
  const Measurement m = make_table(180, [&](int, int, int) { return noise() % 1000; });
  const MeasurementInterpolator interpolator(m);
  for (int n = 0; n < 20000; ++n) {
    const Vec3d wi = random_direction(random), wo = random_direction(random);
    std::array<double, 3> there{}, back{};
    interpolator.eval(wi, wo, there);
    interpolator.eval(wo, wi, back);
    ASSERT_EQ(there, back);
  }
}

TEST(MerlLookup, DoesNotChangeWhenBothDirectionsTurn) {
  std::mt19937 noise(4), random(5);
  const Measurement m = make_table(360, [&](int, int, int) { return noise() % 1000; });
  const MeasurementInterpolator interpolator(m);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (int n = 0; n < 5000; ++n) {
    const Vec3d wi = random_direction(random), wo = random_direction(random);
    std::array<double, 3> f{}, turned{};
    interpolator.eval(wi, wo, f);
    interpolator.eval({c * wi.x - s * wi.y, s * wi.x + c * wi.y, wi.z},
                      {c * wo.x - s * wo.y, s * wo.x + c * wo.y, wo.z}, turned);
    ASSERT_NEAR(f[0], turned[0], 1e-6);
  }
}

TEST(MerlLookup, NothingBelowTheHorizon) {
  const Measurement m = make_table(180, [](int, int, int) { return 1; });
  EXPECT_FALSE(eval(m, {0, 0, 1}, {1, 0, 0}).exists);
  EXPECT_FALSE(eval(m, {0.6, 0, -0.8}, {0, 0, 1}).exists);
  EXPECT_EQ(eval(m, {0.6, 0, -0.8}, {0, 0, 1}).f[0], 0);
}

TEST(MerlLookup, HostileDirectionsStayInsideTheTable) {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const int n_phi : {180, 360}) {
    const Measurement m = make_table(n_phi, [](int, int, int) { return 1; });
    EXPECT_FALSE(eval(m, {nan, nan, nan}, {0, 0, 1}).exists);
    for (const double bad : {nan, infinite, -infinite, 1e300, 1e-320}) {
      for (const Vec3d& w : {Vec3d{bad, 0, 1}, Vec3d{0, bad, 1}, Vec3d{bad, bad, 1}, Vec3d{0, 0, std::abs(bad)}}) {
        eval(m, w, {0, 0, 1});
        eval(m, {0, 0.6, 0.8}, w);
        eval(m, w, w);
      }
    }
  }
}

TEST(MerlLookup, TablesWhoseSizesDisagreeAreRefused) {
  Measurement m = make_table(180, [](int, int, int) { return 1; });
  table_of(m).valid.pop_back();
  EXPECT_THROW(MeasurementInterpolator{m}, std::runtime_error);
  Measurement empty;
  EXPECT_THROW(MeasurementInterpolator{empty}, std::runtime_error);
}

}  // namespace
}  // namespace brdf

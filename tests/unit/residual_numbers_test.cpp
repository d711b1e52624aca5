// SPDX-License-Identifier: Apache-2.0
// Half floats, parameter codes, channel transforms and the coordinates of the grid.
#include "residual/channel_transform.h"
#include "residual/grid_coordinates.h"
#include "residual/half_float.h"
#include "residual/residual_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace brdf::residual {
namespace {

/// IEEE 754 binary16 read as its definition says.
double half_value(std::uint16_t h) { return std::ldexp(1024 + (h & 0x3ff), static_cast<int>(h >> 10) - 25); }

TEST(HalfFloat, ReadsEveryPositiveNormal) {
  for (std::uint16_t h = half_min_normal; h <= half_max; ++h) {
    ASSERT_TRUE(is_positive_normal_half(h));
    ASSERT_EQ(static_cast<double>(float_from_half(h)), half_value(h)) << h;
    ASSERT_EQ(half_from_float(float_from_half(h)), h);
  }
}

TEST(HalfFloat, RoundsToNearestTiesToEven) {
  for (std::uint16_t h = half_min_normal; h < half_max; ++h) {
    const auto low = static_cast<float>(half_value(h));
    const auto high = static_cast<float>(half_value(static_cast<std::uint16_t>(h + 1)));
    const float middle = 0.5F * (low + high);  // exact
    ASSERT_EQ(half_from_float(middle), h % 2 == 0 ? h : h + 1) << h;
    ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0F)), h);
    ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9F)), h + 1);
  }
}

TEST(HalfFloat, ClampsToThePositiveNormals) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const float x : {0.0F, -1.0F, -inf, 1e-30F, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(half_from_float(x), half_min_normal) << x;
  for (const float x : {65504.0F, 65519.0F, 65520.0F, 1e30F, inf}) EXPECT_EQ(half_from_float(x), half_max) << x;
  EXPECT_FALSE(is_positive_normal_half(0));
  EXPECT_FALSE(is_positive_normal_half(0x7c00));
  EXPECT_FALSE(is_positive_normal_half(0xbc00));
}

TEST(ParameterCodes, HaveTheValuesOfTheFormat) {
  for (int c = 0; c <= 31; ++c) EXPECT_DOUBLE_EQ(kappa_h_of(c), 0.003 * std::pow(2, c / 3.0));
  for (int c = 0; c <= 15; ++c) EXPECT_DOUBLE_EQ(kappa_d_of(c), 0.125 * std::pow(2, c / 2.0));
  for (int c = 0; c <= 15; ++c) EXPECT_DOUBLE_EQ(window_of(c), 0.02 * std::pow(2, c / 2.5));
  for (int c = 0; c <= 255; ++c) EXPECT_EQ(epsilon_of(c), std::pow(2.0, c - 128));
  for (int c = 0; c <= 255; ++c) EXPECT_DOUBLE_EQ(step_of(c), std::pow(2.0, 4 - c / 8.0));
}

TEST(ParameterCodes, NearestCodeIsTheInverse) {
  for (int c = 0; c <= 31; ++c) EXPECT_EQ(kappa_h_code(kappa_h_of(c)), c);
  for (int c = 0; c <= 15; ++c) EXPECT_EQ(kappa_d_code(kappa_d_of(c)), c);
  for (int c = 0; c <= 15; ++c) EXPECT_EQ(window_code(window_of(c)), c);
  for (int c = 0; c <= largest_epsilon_code; ++c) EXPECT_EQ(epsilon_code(epsilon_of(c)), c);
  for (int c = 0; c <= 255; ++c) EXPECT_EQ(step_code(step_of(c)), c);
}

TEST(ParameterCodes, ClampWhatIsOutside) {
  for (const double v : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-300}) {
    EXPECT_EQ(kappa_h_code(v), 0);
    EXPECT_EQ(epsilon_code(v), 0);
    EXPECT_EQ(window_code(v), 0);
  }
  EXPECT_EQ(kappa_h_code(1e300), 31);
  EXPECT_EQ(kappa_d_code(1e300), 15);
  EXPECT_EQ(window_code(1e300), 15);
  EXPECT_EQ(epsilon_code(1e300), largest_epsilon_code);
  EXPECT_EQ(step_code(1e300), 0);
  EXPECT_EQ(step_code(0), 255);
}

TEST(ChannelMatrix, IsOrthonormal) {
  for (const auto t : {ChannelTransform::identity, ChannelTransform::opponent, ChannelTransform::cosine})
    for (const int n : {1, 2, 3, 4, 7, 31, 195}) {
      const auto m = channel_matrix(t, n);
      const auto size = static_cast<std::size_t>(n);
      ASSERT_EQ(m.size(), size * size);
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) {
          double dot = 0;
          for (std::size_t c = 0; c < size; ++c) dot += m[i * size + c] * m[j * size + c];
          ASSERT_NEAR(dot, i == j ? 1.0 : 0.0, 1e-12) << static_cast<int>(t) << " " << n;
        }
    }
}

TEST(ChannelMatrix, RowsAreThoseOfTheFormat) {
  const auto m = channel_matrix(ChannelTransform::opponent, 3);
  const double s3 = std::sqrt(3), s2 = std::sqrt(2), s6 = std::sqrt(6);
  const std::vector<double> expected{1 / s3, 1 / s3, 1 / s3, 1 / s2, 0, -1 / s2, 1 / s6, -2 / s6, 1 / s6};
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(m[i], expected[i], 1e-15);
  const auto c = channel_matrix(ChannelTransform::cosine, 4);
  EXPECT_NEAR(c[0], 0.5, 1e-15);
  EXPECT_NEAR(c[1 * 4 + 0], std::sqrt(0.5) * std::cos(std::numbers::pi / 8), 1e-15);
  EXPECT_NEAR(c[3 * 4 + 2], std::sqrt(0.5) * std::cos(3 * std::numbers::pi * 2.5 / 4), 1e-15);
  // opponent is for three channels; elsewhere it means identity
  EXPECT_EQ(channel_matrix(ChannelTransform::opponent, 4), channel_matrix(ChannelTransform::identity, 4));
}

TEST(GridCoordinates, UnwarpIsTheInverseOfWarp) {
  for (int code = 0; code <= 31; ++code)
    for (const double kappa : {kappa_h_of(code), kappa_d_of(code / 2)})
      for (int i = 0; i <= 2000; ++i) {
        const double t = i / 2000.0;
        ASSERT_NEAR(unwarp(warp(t, kappa), kappa), t, 1e-12) << kappa;
        ASSERT_NEAR(warp(unwarp(t, kappa), kappa), t, 1e-12) << kappa;
      }
}

TEST(GridCoordinates, WarpIsMonotoneFromZeroToOne) {
  for (int code = 0; code <= 31; ++code) {
    const double kappa = kappa_h_of(code);
    EXPECT_EQ(warp(0.0, kappa), 0);
    EXPECT_NEAR(warp(1.0, kappa), 1, 1e-15);
    for (int i = 1; i <= 1000; ++i) ASSERT_GT(warp(i / 1000.0, kappa), warp((i - 1) / 1000.0, kappa));
  }
}

TEST(GridCoordinates, ChordIsTheSineOfHalfTheAngle) {
  for (int i = 0; i <= 90; ++i) {
    const double theta = i * std::numbers::pi / 180;
    EXPECT_NEAR(chord(std::sin(theta), std::cos(theta)), std::numbers::sqrt2 * std::sin(theta / 2), 1e-15);
  }
  EXPECT_NEAR(chord(1e-9, 1.0), 1e-9 / std::numbers::sqrt2, 1e-24);  // no cancellation
}

TEST(GridCoordinates, PhiCoordinateHasItsFixedPointsAndInverse) {
  EXPECT_EQ(phi_coordinate(1.0), 0);
  EXPECT_EQ(phi_coordinate(0.0), 0.5);
  EXPECT_EQ(phi_coordinate(-1.0), 1);
  for (int i = 0; i <= 1000; ++i) {
    const double v = i / 1000.0;
    EXPECT_NEAR(phi_coordinate(cos_phi_of(v)), v, 1e-12);
    EXPECT_NEAR(phi_coordinate(cos_phi_of(v)) + phi_coordinate(-cos_phi_of(v)), 1, 1e-12);  // symmetric about pi/2
  }
}

}  // namespace
}  // namespace brdf::residual

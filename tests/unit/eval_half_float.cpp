// SPDX-License-Identifier: Apache-2.0
#include "residual/half_float.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace brdf::residual;

static_assert(float_from_half(0x3c00) == 1.0f);
static_assert(half_from_float(1.0f) == 0x3c00);
static_assert(float_from_half(half_max) == half_max_value);
static_assert(float_from_half(half_min_normal) == half_min_normal_value);

TEST(HalfFloat, EveryPositiveNormalValueSurvivesTheRoundTrip) {
  for (unsigned h = half_min_normal; h <= half_max; ++h) {
    const auto half = static_cast<std::uint16_t>(h);
    const double exact = std::ldexp(1024.0 + (h & 0x3ffu), static_cast<int>(h >> 10) - 25);
    ASSERT_EQ(static_cast<double>(float_from_half(half)), exact) << h;
    ASSERT_EQ(half_from_float(float_from_half(half)), half) << h;
  }
}

TEST(HalfFloat, RoundsToNearestAndTiesToEven) {
  for (unsigned h = half_min_normal; h < half_max; ++h) {
    const float low = float_from_half(static_cast<std::uint16_t>(h)), high = float_from_half(static_cast<std::uint16_t>(h + 1));
    const float middle = 0.5f * (low + high);
    ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0f)), h);
    ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9f)), h + 1);
    ASSERT_EQ(half_from_float(middle) & 1u, 0u) << h;
  }
}

TEST(HalfFloat, ClampsToThePositiveNormalRange) {
  for (float x : {0.0f, -1.0f, 1e-9f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(half_from_float(x), half_min_normal) << x;
  for (float x : {65504.0f, 65519.0f, 65520.0f, 1e30f, std::numeric_limits<float>::infinity()})
    EXPECT_EQ(half_from_float(x), half_max) << x;
}

}  // namespace

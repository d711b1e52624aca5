// SPDX-License-Identifier: Apache-2.0
// The fast look-up of the raw table against the library's interpolator, which works in double.
#include "peers/raw_table.h"

#include "support/direction_batch.h"
#include "support/simd_targets.h"
#include "support/small_measurement.h"

#include <brdf/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace brdf {
namespace {

const HalfDifferenceTable& table_of(const Measurement& m) { return std::get<HalfDifferenceTable>(m.table); }

/// Smooth values in every cell, also below the horizon, so that no corner is missing.
Measurement filled_measurement(const test::TableShape& shape, SamplePosition position = SamplePosition::edge) {
  Measurement m = test::bumpy_measurement(shape);
  auto& t = std::get<HalfDifferenceTable>(m.table);
  t.position = position;
  std::ranges::fill(t.valid, std::uint8_t{1});
  std::size_t at = 0;
  for (int i = 0; i < t.n_theta_h; ++i)
    for (int j = 0; j < t.n_theta_d; ++j)
      for (int k = 0; k < t.n_phi_d; ++k)
        for (int c = 0; c < 3; ++c)
          t.values[at++] =
              static_cast<float>(2 + std::sin(0.3 * i) + 0.5 * std::cos(0.4 * j) + 0.2 * std::sin(0.9 * k) + 0.1 * c);
  return m;
}

struct Differences {
  double worst = 0;         ///< |f - reference| / (0.01 + reference)
  double scalar_worst = 0;  ///< batch against single pairs, the same way
  std::size_t beyond = 0;   ///< values that differ by more than 1 in 1000
};

Differences compare(const Measurement& m, const test::DirectionBatch& wi, const test::DirectionBatch& wo) {
  const peers::RawTable raw(table_of(m));
  const MeasurementInterpolator reference(m);
  const std::size_t n = wi.size();
  std::vector<float> f(3 * n, -1.0F);
  raw.eval(wi.span(), wo.span(), {f.data(), n});
  Differences d;
  for (std::size_t i = 0; i < n; ++i) {
    std::array<double, 3> expected{};
    std::array<float, 3> single{};
    reference.eval(Vec3d(wi[i]), Vec3d(wo[i]), expected);
    raw.eval(wi[i], wo[i], std::span<float, 3>(single));
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = f[c * n + i], scale = 0.01 + expected[c];
      const double error = std::abs(value - expected[c]) / scale;
      d.worst = std::max(d.worst, error);
      d.scalar_worst = std::max(d.scalar_worst, std::abs(value - static_cast<double>(single[c])) / scale);
      d.beyond += error > 1e-3 ? 1 : 0;
    }
  }
  return d;
}

TEST(RawTable, AgreesWithTheInterpolatorWhereEveryCornerIsMeasured) {
  constexpr std::size_t pairs = 20001;  // no whole number of blocks or vectors
  const test::DirectionBatch wi = test::random_directions(pairs, 1), wo = test::random_directions(pairs, 2);
  for (const bool full_circle : {false, true}) {
    for (const SamplePosition position : {SamplePosition::edge, SamplePosition::centre}) {
      const Measurement m = filled_measurement({90, 90, full_circle ? 360 : 180, full_circle}, position);
      test::on_every_target([&] {
        const Differences d = compare(m, wi, wo);
        EXPECT_LT(d.worst, 2e-3);
        EXPECT_LT(d.scalar_worst, 2e-3);
        EXPECT_LT(d.beyond, 3U);
      });
    }
  }
}

TEST(RawTable, AgreesWithTheInterpolatorWithinAMeasuredTable) {
  // Where a corner is below the horizon the interpolator leaves it out and the table has a neighbours' mean.
  constexpr std::size_t pairs = 20000;
  test::DirectionBatch wi = test::random_directions(pairs, 3), wo = test::random_directions(pairs, 4);
  const Measurement m = test::bumpy_measurement({90, 90, 180});
  const Differences d = compare(m, wi, wo);
  EXPECT_LT(static_cast<double>(d.beyond), 0.06 * 3 * pairs);
  EXPECT_LT(d.scalar_worst, 2e-3);
}

TEST(RawTable, ReadsSmallTables) {
  const Measurement m = filled_measurement({2, 2, 2});
  const Differences d = compare(m, test::random_directions(100, 5), test::random_directions(100, 6));
  EXPECT_LT(d.worst, 1e-4);
}

TEST(RawTable, StaysInTheTableWhateverTheDirections) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const peers::RawTable raw(table_of(filled_measurement({90, 90, 180})));
  test::DirectionBatch wi, wo;
  const std::array values{0.0F, 1.0F, -1.0F, 1e-38F, nan, infinity, -infinity, 3e38F};
  for (const float x : values)
    for (const float y : values)
      for (const float z : values) {
        wi.push({x, y, z});
        wo.push({y, -x, 0.5F});
      }
  std::vector<float> f(3 * wi.size());
  test::on_every_target([&] { raw.eval(wi.span(), wo.span(), {f.data(), wi.size()}); });
  std::array<float, 3> single{};
  for (std::size_t i = 0; i < wi.size(); ++i) {
    raw.eval(wi[i], wo[i], std::span<float, 3>(single));
    if (!(wi[i].z > 0)) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(f[c * wi.size() + i], 0.0F);
      EXPECT_EQ(single, (std::array<float, 3>{}));
    }
  }
}

TEST(RawTable, AtNormalIncidence) {
  const Measurement m = filled_measurement({90, 90, 180});
  test::DirectionBatch up;
  up.push({0, 0, 1});
  EXPECT_LT(compare(m, up, up).worst, 1e-5);
}

TEST(RawTable, RefusesTablesThatContradictThemselves) {
  HalfDifferenceTable t = table_of(filled_measurement({4, 4, 4}));
  const auto refused = [](const HalfDifferenceTable& table) {
    EXPECT_THROW({ const peers::RawTable raw(table); }, Error);
  };
  HalfDifferenceTable other = t;
  other.values.pop_back();
  refused(other);
  other = t;
  other.valid.pop_back();
  refused(other);
  other = t;
  other.n_phi_d = 1;
  refused(other);
  other = t;
  other.n_theta_h = -4;
  refused(other);
}

TEST(RawTable, HoldsThePublishedSize) {
  const peers::RawTable raw(table_of(filled_measurement({90, 90, 180})));
  EXPECT_EQ(raw.resident_bytes(), 90U * 90 * 181 * 12);
}

TEST(RawTable, ResamplesToMerl) {
  const Measurement m = test::bumpy_measurement({90, 90, 180});
  const HalfDifferenceTable t = peers::resample_to_merl(m);
  ASSERT_EQ(t.values.size(), 3U * 90 * 90 * 180);
  const HalfDifferenceTable& source = table_of(m);
  std::size_t off = 0;
  for (std::size_t cell = 0; cell < t.valid.size(); ++cell)
    if (t.valid[cell] != 0 && source.valid[cell] != 0)
      for (std::size_t c = 0; c < 3; ++c)
        off += std::abs(t.values[3 * cell + c] - source.values[3 * cell + c]) > 1e-4F * source.values[3 * cell + c] ? 1
                                                                                                                    : 0;
  EXPECT_LT(off, t.valid.size() / 1000);
}

}  // namespace
}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
#include "support/expect_error.h"
#include "support/made_profile.h"
#include "support/small_measurement.h"

#include <brdf/trade.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace brdf {
namespace {

TradeOptions small_trade(const Measurement& m) {
  TradeOptions o;
  o.encode.effort = 0;
  o.encode.profile = std::make_shared<const MaterialProfile>(
      test::made_profile(m, [](const Vec3d& wi, const Vec3d& wo) { return test::difference_angle(wi, wo) < 0.4; }, 30000));
  o.sizes = {20, 56, 96, 250, 600};  // nothing fits into the first
  return o;
}

/// As the renderer would see them: more bytes of tables, more time.
double pretended_nanoseconds(const Material& m) { return 5 + static_cast<double>(m.lobes().lobes.size()) + static_cast<double>(m.resident_bytes()) / 4096; }

TEST(Trade, EachPointIsAFileThatDecodes) {
  const Measurement m = test::bumpy_measurement();
  TradeOptions o = small_trade(m);
  int timed = 0;
  o.nanoseconds = [&](const Material& material) {
    ++timed;
    return pretended_nanoseconds(material);
  };
  const std::vector<TradePoint> points = measure_trade(m, o);
  ASSERT_GE(points.size(), 4U);
  std::set<Representation> seen;
  for (const TradePoint& p : points) {
    seen.insert(p.representation);
    ASSERT_LE(p.bytes, p.file->size());
    DecodeOptions decode;
    decode.level = p.level;
    decode.allow_prefix = true;
    const Material material = Material::decode(std::span(*p.file).first(p.bytes), decode);
    EXPECT_EQ(static_cast<int>(material.lobes().lobes.size()), p.lobes);
    EXPECT_EQ(material.info().refinements_read, p.refinements);
    EXPECT_EQ(material.resident_bytes(), p.resident_bytes);
    EXPECT_EQ(p.nanoseconds, pretended_nanoseconds(material));
    EXPECT_GT(p.error.rms, 0);
    EXPECT_EQ(p.level == EvalLevel::fast, p.refinements == 0);
  }
  EXPECT_TRUE(seen.contains(Representation::half_difference));
  EXPECT_TRUE(seen.contains(Representation::single_lobe) || seen.contains(Representation::lobes));
  EXPECT_LT(timed, 12) << "what evaluates alike is timed once";
  // nothing beats anything else, and bytes ascend
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_LE(points[k].bytes, points[i].bytes);
      EXPECT_TRUE(points[i].error.rms < points[k].error.rms || points[i].nanoseconds < points[k].nanoseconds);
    }
}

TEST(Trade, WithoutAClockTimeDoesNotCount) {
  const Measurement m = test::bumpy_measurement();
  const std::vector<TradePoint> points = measure_trade(m, small_trade(m));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(std::isnan(points[i].nanoseconds));
    if (i > 0) {
      EXPECT_LT(points[i].error.rms, points[i - 1].error.rms);
    }
  }
  EXPECT_LT(points.back().error.rms, 0.8 * points.front().error.rms);
}

// A plan over two materials: the one that matters gets the bytes.
TEST(Trade, AnAllocationSpendsWhereItCounts) {
  const Measurement m = test::bumpy_measurement();
  const std::vector<TradePoint> points = measure_trade(m, small_trade(m));
  std::vector<Alternative> one;
  for (const TradePoint& p : points) one.push_back({static_cast<double>(p.bytes), p.error.rms * p.error.rms});
  const std::vector<std::vector<Alternative>> items = {one, one};
  const double budget = one.front().cost + one.back().cost;
  const Allocation a = allocate(items, std::vector<double>{1, 1e-9}, budget);
  EXPECT_LE(a.cost, budget);
  EXPECT_EQ(a.choice[0], one.size() - 1);
  EXPECT_EQ(a.choice[1], 0U);
}

TEST(Trade, RefusesWhatHasNoAnswer) {
  const Measurement m = test::bumpy_measurement();
  test::expect_error(ErrorCode::invalid_argument, {"needs a profile"}, [&] { measure_trade(m, {}); });
  TradeOptions o = small_trade(m);
  o.sizes = {20};
  test::expect_error(ErrorCode::target_not_met, {"smallest file"}, [&] { measure_trade(m, o); });
  o.sizes.clear();
  test::expect_error(ErrorCode::invalid_argument, {"no sizes"}, [&] { measure_trade(m, o); });
  o = small_trade(m);
  test::expect_error(ErrorCode::cancelled, {"cancelled"}, [&] { measure_trade(m, o, [](std::string_view, double) { return false; }); });
}

}  // namespace
}  // namespace brdf

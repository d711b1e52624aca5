// SPDX-License-Identifier: Apache-2.0
// Targets are promises: sizes are used up and never exceeded, errors are met on the decoded file.
#include "support/expect_error.h"
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace brdf {
namespace {

using test::expect_error;

EncodeOptions sized(std::uint64_t bytes, int effort = 0) {
  EncodeOptions o;
  o.effort = effort;
  o.target_size = bytes;
  return o;
}

EncodeOptions aimed(ErrorTarget target, EvalLevel level = EvalLevel::balanced, int effort = 0) {
  EncodeOptions o;
  o.effort = effort;
  o.target_error = target;
  o.level = level;
  return o;
}

/// On all queries, as `compare` measures it.
ErrorReport full_report(const Measurement& m, std::span<const std::byte> bytes, EvalLevel level = EvalLevel::balanced) {
  const MeasurementInterpolator reference(m);
  const auto n = static_cast<std::size_t>(m.channels.count);
  const Comparison comparison(
      [&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
        std::vector<double> f(n);
        for (std::size_t i = 0; i < wi.size(); ++i) {
          reference.eval(Vec3d(wi[i]), Vec3d(wo[i]), f);
          std::copy(f.begin(), f.end(), out.begin() + static_cast<std::ptrdiff_t>(i * n));
        }
      },
      m.channels.count);
  DecodeOptions options;
  options.level = level;
  const Material material = Material::decode(bytes, options);
  return comparison.score([&](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i) material.eval(wi[i], wo[i], out.subspan(i * n, n));
  });
}

double merit(const ErrorReport& r) { return (r.psnr_env + r.psnr_lights - 20 * std::log10(r.log_mae.all)) / 3; }

/// Sizes from 48 bytes up: never over; used up to 2 % or 8 bytes, unless a larger file is no better either; never worse.
void expect_sizes_hold(const Measurement& m) {
  double best = -1e9;
  std::uint64_t unused = 0;  // a target that was not used up
  for (const std::uint64_t size : {48U, 64U, 128U, 300U, 512U, 1024U, 2048U, 4096U, 16384U}) {
    const EncodeResult r = compress(m, sized(size));
    ASSERT_LE(r.bytes.size(), size);
    const double now = merit(full_report(m, r.bytes));
    EXPECT_GT(now, best - 0.2) << size;  // what the queries of the lowest effort tell apart
    if (unused > 0 && unused >= 200) {
      EXPECT_LT(now, best + 0.5) << "bytes beyond " << unused << " do lower the error";
    }
    best = std::max(best, now);
    if (r.bytes.size() + std::max<std::uint64_t>(size / 50, 8) < size) unused = size;
  }
}

TEST(Targets, SizesAreUsedUpSlow) { expect_sizes_hold(test::bumpy_measurement()); }
TEST(Targets, SizesAreUsedUpInSlicesSlow) { expect_sizes_hold(test::slice_measurement()); }

TEST(Targets, FortyEightBytesHoldALobe) {
  for (const Measurement& m : {test::bumpy_measurement(), test::slice_measurement()}) {
    const EncodeResult r = compress(m, sized(48));
    EXPECT_LE(r.bytes.size(), 48U);
    EXPECT_GE(r.summary.lobes, 1);
    EXPECT_LE(compress(m, sized(36)).bytes.size(), 36U) << "one lobe of three channels";
  }
}

TEST(Targets, ErrorsAreMetOnAllQueriesSlow) {
  const Measurement m = test::bumpy_measurement();
  for (const ErrorTarget target : {ErrorTarget{Metric::log_mae, 0.003}, ErrorTarget{Metric::psnr_env, 40}}) {
    const EncodeResult r = compress(m, aimed(target));
    EXPECT_TRUE(full_report(m, r.bytes).meets(target)) << to_string(target.metric);
  }
}

TEST(Targets, SlicesAreTriedForErrorsSlow) {
  const Measurement m = test::slice_measurement();
  const EncodeResult r = compress(m, aimed({Metric::log_mae, 0.003}, EvalLevel::exact));
  EXPECT_TRUE(full_report(m, r.bytes, EvalLevel::exact).meets({Metric::log_mae, 0.003}));
}

TEST(Targets, ErrorsAreMetWithFewBytes) {
  // the smallest file is not far from where a search by size meets the same error
  const Measurement m = test::bumpy_measurement();
  const EncodeResult by_error = compress(m, aimed({Metric::log_mae, 0.003}));
  const EncodeResult smaller = compress(m, sized(by_error.bytes.size() * 8 / 10));
  EXPECT_GT(full_report(m, smaller.bytes).log_mae.all, 0.003);
}

TEST(Targets, LobesAloneHaveNoBetterFastLevel) {
  EncodeOptions o = sized(4096);
  o.level = EvalLevel::fast;
  EXPECT_EQ(compress(test::bumpy_measurement(), o).summary.refinements, 0) << "the level reads nothing else";
  expect_error(ErrorCode::target_not_met, {"log_mae", "fast", "best reachable"},
               [&] { compress(test::bumpy_measurement(), aimed({Metric::log_mae, 1e-4}, EvalLevel::fast)); });
}

}  // namespace
}  // namespace brdf

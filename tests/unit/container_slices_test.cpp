// SPDX-License-Identifier: Apache-2.0
// The frame of a residual in slice coordinates, as bytes and in files.
#include "container/content.h"
#include "container/slice_frame_codes.h"
#include "support/expect_error.h"
#include "support/slice_measurement.h"

#include <brdf/encode.h>
#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace brdf::container {
namespace {

residual::SliceFrame small_frame() {
  residual::SliceFrame f;
  f.theta_i = {0, 30000, 65535};
  f.width = 8;
  f.height = 6;
  f.rows = 16;
  f.ndf_step = 6;
  f.ndf = {20, 18, 10, -4, -30};
  f.epsilon = 120;
  return f;
}

void expect_same(const residual::SliceFrame& a, const residual::SliceFrame& b) {
  EXPECT_EQ(a.theta_i, b.theta_i);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.ndf_step, b.ndf_step);
  EXPECT_EQ(a.ndf, b.ndf);
  EXPECT_EQ(a.epsilon, b.epsilon);
}

TEST(SliceFrameCodes, ComeBackAndLeaveWhatFollows) {
  std::vector<std::byte> bytes = write_slice_frame(small_frame());
  bytes.push_back(std::byte{42});
  std::span<const std::byte> rest = bytes;
  expect_same(read_slice_frame(rest), small_frame());
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0], std::byte{42});
}

RC_GTEST_PROP(SliceFrameCodes, AnyValidFrameComesBack, ()) {
  residual::SliceFrame f = small_frame();
  f.ndf_step = static_cast<std::uint8_t>(*rc::gen::inRange(0, residual::max_ndf_step + 1));
  const int largest = static_cast<int>(30 * std::exp2(0.5 * f.ndf_step));
  f.ndf = *rc::gen::container<std::vector<std::int16_t>>(static_cast<std::size_t>(*rc::gen::inRange(3, 256)),
                                                        rc::gen::cast<std::int16_t>(rc::gen::inRange(-largest, largest + 1)));
  const std::vector<std::byte> bytes = write_slice_frame(f);
  std::span<const std::byte> rest = bytes;
  expect_same(read_slice_frame(rest), f);
  RC_ASSERT(rest.empty());
}

TEST(SliceFrameCodes, EveryShorterStringIsRefused) {
  const std::vector<std::byte> bytes = write_slice_frame(small_frame());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::span<const std::byte> rest = std::span(bytes).first(n);
    test::expect_error(ErrorCode::malformed, {"slice frame"}, [&] { read_slice_frame(rest); });
  }
}

TEST(SliceFrameCodes, RefusesWhatCannotBeEvaluated) {
  const auto refused = [](auto&& change, const char* words) {
    residual::SliceFrame f = small_frame();
    change(f);
    const std::vector<std::byte> bytes = write_slice_frame(f);
    std::span<const std::byte> rest = bytes;
    test::expect_error(ErrorCode::malformed, {words}, [&] { read_slice_frame(rest); });
  };
  refused([](auto& f) { f.theta_i = {5}; }, "slices");
  refused([](auto& f) { f.theta_i = {5, 5}; }, "ascend");
  refused([](auto& f) { f.width = 1; }, "width");
  refused([](auto& f) { f.width = 100; }, "width");
  refused([](auto& f) { f.height = 1; }, "height");
  refused([](auto& f) { f.height = 100; }, "height");
  refused([](auto& f) { f.rows = 3; }, "rows");
  refused([](auto& f) { f.ndf_step = 21; }, "step");
  refused([](auto& f) { f.ndf = {0, 0}; }, "ndf");
  refused([](auto& f) { f.ndf[2] = 20000; }, "ndf");
  refused([](auto& f) { f.epsilon = 255; }, "epsilon");
}

TEST(SliceFile, AMeasurementInSlicesIsWrittenInItsOwnCoordinates) {
  const Measurement m = test::slice_measurement();
  EncodeOptions options;
  options.target_size = 900;
  const EncodeResult r = compress(m, options);
  ASSERT_LE(r.bytes.size(), 900U);
  const Unpacked file = unpack(r.bytes, {}, false);
  EXPECT_EQ(file.content.component.axes, AxesKind::slices);
  EXPECT_FALSE(file.content.component.reciprocal);
  EXPECT_FALSE(file.content.residual.slices.empty());

  // every boundary decodes, counts itself and lowers the error that it records
  const auto ends = refinement_boundaries(r.bytes);
  ASSERT_GE(ends.size(), 2U);
  DecodeOptions prefix;
  prefix.allow_prefix = true;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const Material part = Material::decode(std::span(r.bytes).first(ends[k]), prefix);
    EXPECT_EQ(part.info().refinements_read, static_cast<int>(k));
    EXPECT_EQ(part.info().refinements_total, static_cast<int>(ends.size()) - 1);
  }
  double before = 1e9;
  const Material whole = Material::decode(r.bytes);
  for (const RecordedError& e : whole.info().errors)
    if (e.level != EvalLevel::exact) {
      EXPECT_LT(e.log_mae, before);
      before = e.log_mae;
    }
}

TEST(SliceFile, TheTableCountsAgainstTheLimit) {
  EncodeOptions options;
  options.effort = 0;
  options.target_size = 900;
  const EncodeResult r = compress(test::slice_measurement(), options);
  ASSERT_EQ(unpack(r.bytes, {}, false).content.component.axes, AxesKind::slices);
  DecodeOptions tight;
  tight.limits.max_table_bytes = 10000;
  for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact}) {
    tight.level = level;
    test::expect_error(ErrorCode::limit_exceeded, {to_string(level), "10000"}, [&] { Material::decode(r.bytes, tight); });
  }
}

TEST(SliceFile, ReciprocityOnDemandLeavesTheSlices) {
  EncodeOptions options;
  options.target_size = 900;
  options.reciprocity = SymmetryMode::enforce;
  const EncodeResult r = compress(test::slice_measurement(), options);
  EXPECT_EQ(unpack(r.bytes, {}, false).content.component.axes, AxesKind::half_difference);
  EXPECT_TRUE(Material::decode(r.bytes).info().reciprocal);
}

TEST(SliceFile, ThreadsDoNotChangeTheBytes) {
  const Measurement m = test::slice_measurement();
  EncodeOptions options;
  options.effort = 25;
  options.target_size = 700;
  const EncodeResult one = compress(m, options);
  options.threads = 3;
  EXPECT_EQ(compress(m, options).bytes, one.bytes);
}

}  // namespace
}  // namespace brdf::container

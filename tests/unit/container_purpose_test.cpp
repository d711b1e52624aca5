// SPDX-License-Identifier: Apache-2.0
#include "container/purpose_codes.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brdf::container {
namespace {

FittedFor some_purpose() {
  FittedFor p;
  p.operations = 0b0101;
  p.level = EvalLevel::exact;
  p.theta_i_least = 0.1F;
  p.theta_i_most = 1.2F;
  p.theta_o_least = 0;
  p.theta_o_most = 1.5707F;
  p.share = 0.25;
  p.footprint_pixels = 1000;
  p.rms = 0.031;
  p.log_error = 0;
  return p;
}

TEST(Purpose, NineBytesGiveBackWhatTheyHold) {
  const FittedFor p = some_purpose();
  const std::vector<std::byte> bytes = write_purpose(p);
  ASSERT_EQ(bytes.size(), 9U);
  const FittedFor back = read_purpose(bytes);
  EXPECT_EQ(back.operations, p.operations);
  EXPECT_EQ(back.level, p.level);
  EXPECT_LE(back.theta_i_least, p.theta_i_least);
  EXPECT_GE(back.theta_i_least, p.theta_i_least - 0.0088F);
  EXPECT_GE(back.theta_i_most, p.theta_i_most);
  EXPECT_LE(back.theta_i_most, p.theta_i_most + 0.0088F);
  EXPECT_EQ(back.theta_o_least, 0);
  EXPECT_FLOAT_EQ(back.theta_o_most, 1.57079633F);
  EXPECT_DOUBLE_EQ(back.share, 0.25);
  EXPECT_NEAR(back.footprint_pixels, 1000, 45);
  EXPECT_GE(back.rms, p.rms);
  EXPECT_LE(back.rms, p.rms * std::exp2(0.125));
  EXPECT_EQ(back.log_error, 0);
  EXPECT_EQ(write_purpose(back), bytes);
}

TEST(Purpose, ExtremesHaveCodes) {
  FittedFor p;
  p.rms = p.log_error = std::numeric_limits<double>::infinity();
  p.footprint_pixels = 1e300;
  p.share = 1;
  const FittedFor back = read_purpose(write_purpose(p));
  EXPECT_NEAR(back.rms, 3.67, 0.01);
  EXPECT_EQ(back.share, 1);
  EXPECT_GT(back.footprint_pixels, 1e7);
  EXPECT_EQ(read_purpose(write_purpose({})).footprint_pixels, 0);
}

TEST(Purpose, OtherBytesAreRefused) {
  std::vector<std::byte> bytes = write_purpose(some_purpose());
  const auto refused = [&](const char* word) { test::expect_error(ErrorCode::malformed, {word}, [&] { read_purpose(bytes); }); };
  bytes[2] = std::byte{181};
  refused("half degrees");
  bytes = write_purpose(some_purpose());
  bytes[0] = std::byte{0x35};
  refused("level 3");
  bytes.pop_back();
  refused("8 bytes");
  bytes.resize(10);
  refused("10 bytes");
}

}  // namespace
}  // namespace brdf::container

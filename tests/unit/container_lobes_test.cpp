// SPDX-License-Identifier: Apache-2.0
#include "container/error_codes.h"
#include "container/lobe_codes.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brdf::container {
namespace {

std::vector<std::byte> written(const LobeSet& set) {
  BitWriter out;
  write_lobes(out, set);
  return out.bytes();
}

LobeSet random_lobes(test::Lcg& random, int channels) {
  LobeSet set{channels, {}};
  const double scale = std::exp2(8 * random.unit() - 6);
  for (std::uint32_t i = 0, n = random.below(6); i < n; ++i) {
    Lobe lobe;
    lobe.kind = static_cast<LobeKind>(random.below(3));
    lobe.alpha = std::pow(1e-5, random.unit());
    lobe.f90 = scale * random.unit();
    for (int c = 0; c < channels; ++c) lobe.color.push_back(scale * std::pow(random.unit(), 3));
    set.lobes.push_back(lobe);
  }
  return set;
}

void expect_equal(const LobeSet& a, const LobeSet& b) {
  ASSERT_EQ(a.lobes.size(), b.lobes.size());
  for (std::size_t i = 0; i < a.lobes.size(); ++i) {
    EXPECT_EQ(a.lobes[i].kind, b.lobes[i].kind);
    EXPECT_EQ(a.lobes[i].color, b.lobes[i].color);
    if (a.lobes[i].kind == LobeKind::lambert) continue;
    EXPECT_EQ(a.lobes[i].alpha, b.lobes[i].alpha);
    EXPECT_EQ(a.lobes[i].f90, b.lobes[i].f90);
  }
}

TEST(LobeCodes, ParametersSurviveWithinTheStatedPrecision) {
  test::Lcg random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const LobeSet set = random_lobes(random, 3), read = quantise_lobes(set);
    double largest = 0;
    for (const Lobe& l : set.lobes) {
      if (l.kind != LobeKind::lambert) largest = std::max(largest, l.f90);
      for (const double c : l.color) largest = std::max(largest, c);
    }
    const auto expect_near = [&](double found, double wanted) {
      if (wanted > largest * std::exp2(-14.9)) {
        ASSERT_NEAR(found / wanted, 1, 0.003) << wanted;
      } else {
        ASSERT_LE(found, largest * std::exp2(-14.8));  // below sixteen octaves: small or nothing
      }
    };
    ASSERT_EQ(read.lobes.size(), set.lobes.size());
    for (std::size_t i = 0; i < set.lobes.size(); ++i) {
      const Lobe &in = set.lobes[i], &out = read.lobes[i];
      ASSERT_EQ(out.kind, in.kind);
      for (std::size_t c = 0; c < 3; ++c) expect_near(out.color[c], in.color[c]);
      if (in.kind == LobeKind::lambert) continue;
      ASSERT_NEAR(out.alpha / in.alpha, 1, 0.003);
      expect_near(out.f90, in.f90);
    }
  }
}

TEST(LobeCodes, QuantisingTwiceIsQuantisingOnce) {
  test::Lcg random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const LobeSet once = quantise_lobes(random_lobes(random, 1 + trial % 4));
    expect_equal(quantise_lobes(once), once);
  }
}

TEST(LobeCodes, ExtremesOfAlphaAreKept) {
  const auto alpha_of = [](double alpha) {
    return quantise_lobes({1, {{LobeKind::ggx, alpha, 1, {1.0}}}}).lobes[0].alpha;
  };
  EXPECT_EQ(alpha_of(1.0), 1.0);
  EXPECT_NEAR(alpha_of(1e-5), 1e-5, 1e-14);
  EXPECT_NEAR(alpha_of(1e-9), 1e-5, 1e-14);  // clamped
  EXPECT_EQ(alpha_of(3.0), 1.0);
}

TEST(LobeCodes, AmplitudesAreExactAtPowersOfTwoAndAtZero) {
  const LobeSet read = quantise_lobes({4, {{LobeKind::lambert, 1, 1, {1.0, 0.5, 0.25, 0.0}}}});
  EXPECT_EQ(read.lobes[0].color, (std::vector<double>{1.0, 0.5, 0.25, 0.0}));
}

TEST(LobeCodes, BlackAndEmptySets) {
  EXPECT_TRUE(quantise_lobes({3, {}}).lobes.empty());
  EXPECT_EQ(written({3, {}}).size(), 2U);  // 4 + 8 bits
  const LobeSet black = quantise_lobes({3, {{LobeKind::lambert, 1, 1, {0, 0, 0}}}});
  EXPECT_EQ(black.lobes[0].color, (std::vector<double>{0, 0, 0}));
}

TEST(LobeCodes, BitsAreThoseOfTheFormat) {
  // one Lambert lobe, colours 1, 1/2, 0: count 0001, exponent 128 = 10000000, kind 000,
  // 2047 = 11111111111, 2047 - 128 = 11101111111, 0; 4 + 8 + 3 + 33 = 48 bits
  const auto bytes = written({3, {{LobeKind::lambert, 1, 1, {1.0, 0.5, 0.0}}}});
  const std::vector<unsigned> expected{0b00011000, 0b00000001, 0b11111111, 0b11111011, 0b11111000, 0b00000000};
  ASSERT_EQ(bytes.size(), expected.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(static_cast<unsigned>(bytes[i]), expected[i]) << i;
}

TEST(LobeCodes, FifteenLobes) {
  const LobeSet set{1, std::vector<Lobe>(15, Lobe{LobeKind::lambert, 1, 1, {0.1}})};
  EXPECT_EQ(quantise_lobes(set).lobes.size(), 15U);
}

TEST(LobeCodes, UnknownKindIsUnsupported) {
  BitWriter out;
  out.put(1, 4);
  out.put(128, 8);
  out.put(3, 3);
  out.put(0, 11);
  const auto bytes = out.bytes();
  test::expect_error(ErrorCode::unsupported, {"kind 3"}, [&] {
    BitReader in(bytes, "lobes");
    read_lobes(in, 1, 16);
  });
}

TEST(LobeCodes, MoreLobesThanTheLimitAreRefused) {
  const auto bytes = written(test::lobes_of_each_kind(3));
  test::expect_error(ErrorCode::limit_exceeded, {"3", "2"}, [&] {
    BitReader in(bytes, "lobes");
    read_lobes(in, 3, 2);
  });
}

TEST(LobeCodes, MissingBitsAreMalformed) {
  const auto bytes = written(test::lobes_of_each_kind(3));
  for (std::size_t n = 0; n < bytes.size(); ++n)
    test::expect_error(ErrorCode::malformed, {"ends"}, [&] {
      BitReader in(std::span<const std::byte>(bytes).first(n), "lobes");
      read_lobes(in, 3, 16);
    });
}

TEST(ErrorCodes, RoundToThePessimisticSide) {
  test::Lcg random(3);
  for (int i = 0; i < 2000; ++i) {
    const double mae = std::exp2(-28 * random.unit() + 1), psnr = 63.75 * random.unit();
    EXPECT_GE(log_mae_of(log_mae_code(mae)), mae * (1 - 1e-12));
    EXPECT_LE(log_mae_of(log_mae_code(mae)), mae * std::exp2(0.125) * (1 + 1e-12));
    EXPECT_LE(psnr_of(psnr_code(psnr)), psnr);
    EXPECT_GT(psnr_of(psnr_code(psnr)), psnr - 0.25);
  }
  EXPECT_EQ(log_mae_of(log_mae_code(0)), 0);
  EXPECT_EQ(psnr_of(psnr_code(-3)), 0);
  EXPECT_EQ(psnr_of(psnr_code(1e9)), 63.75);
}

TEST(ErrorCodes, CodesAreStable) {
  for (int c = 1; c <= 255; ++c) EXPECT_EQ(log_mae_code(log_mae_of(static_cast<std::uint8_t>(c))), c);
  for (int c = 0; c <= 255; ++c) EXPECT_EQ(psnr_code(psnr_of(static_cast<std::uint8_t>(c))), c);
  EXPECT_EQ(log_mae_of(240), 1.0);
  EXPECT_EQ(log_mae_of(160), 1.0 / 1024);
}

TEST(ErrorCodes, WhatIsNoNumberIsTheWorst) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(log_mae_code(nan), 255);
  EXPECT_EQ(log_mae_code(inf), 255);
  EXPECT_EQ(psnr_code(nan), 0);
  EXPECT_EQ(psnr_code(-inf), 0);
}

}  // namespace
}  // namespace brdf::container

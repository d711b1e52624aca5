// SPDX-License-Identifier: Apache-2.0
#include "container/error_codes.h"
#include "container/bit_stream.h"
#include "container/lobe_codes.h"
#include "container/packed_lobes.h"
#include "residual/range_coder.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brdf::container {
namespace {

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
  EXPECT_LE(write_lobes({3, {}}).size(), 2U);  // 4 + 8 bits, zeros at the end dropped
  const LobeSet black = quantise_lobes({3, {{LobeKind::lambert, 1, 1, {0, 0, 0}}}});
  EXPECT_EQ(black.lobes[0].color, (std::vector<double>{0, 0, 0}));
}

TEST(LobeCodes, FifteenLobes) {
  const LobeSet set{1, std::vector<Lobe>(15, Lobe{LobeKind::lambert, 1, 1, {0.1}})};
  EXPECT_EQ(quantise_lobes(set).lobes.size(), 15U);
}

TEST(LobeCodes, MoreLobesThanTheLimitAreRefused) {
  const auto bytes = write_lobes(test::lobes_of_each_kind(3));
  test::expect_error(ErrorCode::limit_exceeded, {"3", "2"}, [&] { read_lobes(bytes, 3, 2); });
}

TEST(LobeCodes, TheEndIsWhereTheChunkEnds) {
  auto bytes = write_lobes(test::lobes_of_each_kind(31));
  // zeros follow a cut stream: they are a code out of range or too many bytes
  for (std::size_t n = 2; n <= bytes.size() / 2; ++n)
    test::expect_error(ErrorCode::malformed, {"lobes: "}, [&] { read_lobes(std::span(bytes).first(n), 31, 16); });
  bytes.insert(bytes.end(), 5, std::byte{1});
  test::expect_error(ErrorCode::malformed, {"left over"}, [&] { read_lobes(bytes, 31, 16); });
}

TEST(LobeCodes, AmplitudesOutsideTheirRangeAreMalformed) {
  // one Lambert lobe of the widest step upwards: 1500 + 2047
  residual::RangeEncoder coder;
  coder.raw(4, 1);
  coder.raw(8, 128);
  const auto percent = [](int p) { return residual::AdaptiveBit(static_cast<std::uint32_t>(65536 * p / 100)); };
  residual::AdaptiveBit microfacets = percent(40), nonzero = percent(95);
  coder.bit(microfacets, false);
  coder.bit(nonzero, true);
  for (const int p : {99, 98, 97, 96, 95, 93, 90, 80, 57, 25, 10}) {
    residual::AdaptiveBit wider = percent(p);
    coder.bit(wider, true);
  }
  coder.raw(1, 0);
  coder.raw(10, 1023);
  const auto bytes = coder.finish();
  test::expect_error(ErrorCode::malformed, {"3547", "2047"}, [&] { read_lobes(bytes, 1, 16); });
}

TEST(LobeCodes, ColoursOfManyWavelengthsCostLittle) {
  LobeSet set{195, {{LobeKind::lambert, 1, 1, {}}, {LobeKind::ggx, 0.2, 0.9, {}}}};
  for (int c = 0; c < 195; ++c) {
    set.lobes[0].color.push_back(0.3 + 0.2 * std::sin(c / 20.0));
    set.lobes[1].color.push_back(0.05 + 0.01 * std::cos(c / 30.0));
  }
  EXPECT_LT(write_lobes(set).size() * 8, 390U * 5);  // 11 bits each as they are
  expect_equal(read_lobes(write_lobes(set), 195, 16), quantise_lobes(set));
}

/// Lambert and GGX lobes as earlier writers had them.
std::vector<std::byte> packed(std::initializer_list<std::pair<std::uint32_t, int>> fields) {
  BitWriter out;
  for (const auto& [value, bits] : fields) out.put(value, bits);
  return out.bytes();
}

TEST(PackedLobes, BitsAreThoseOfTheFormat) {
  const auto bytes = packed({{2, 4}, {129, 8}, {0, 3}, {2047, 11}, {2047 - 128, 11}, {0, 11}, {1, 3}, {2047, 11}, {2047, 11}, {1791, 11}, {0, 11}, {0, 11}});
  const LobeSet set = read_packed_lobes(bytes, 3, 16);
  ASSERT_EQ(set.lobes.size(), 2U);
  EXPECT_EQ(set.lobes[0].color, (std::vector<double>{2, 1, 0}));
  EXPECT_NEAR(set.lobes[1].alpha, 1e-5, 1e-14);
  EXPECT_EQ(set.lobes[1].f90, 2);
  EXPECT_EQ(set.lobes[1].color, (std::vector<double>{0.5, 0, 0}));
  expect_equal(quantise_lobes(set), set);
}

TEST(PackedLobes, BadOnesAreRefused) {
  test::expect_error(ErrorCode::unsupported, {"kind 3"}, [] { read_packed_lobes(packed({{1, 4}, {128, 8}, {3, 3}, {0, 11}}), 1, 16); });
  test::expect_error(ErrorCode::limit_exceeded, {"3", "2"}, [] { read_packed_lobes(packed({{3, 4}, {128, 8}}), 1, 2); });
  test::expect_error(ErrorCode::malformed, {"2^100"}, [] { read_packed_lobes(packed({{0, 4}, {228, 8}}), 1, 2); });
  test::expect_error(ErrorCode::malformed, {"left over"}, [] { read_packed_lobes(packed({{0, 4}, {128, 8}, {0, 12}}), 1, 2); });
  const auto whole = packed({{1, 4}, {128, 8}, {0, 3}, {2047, 11}});
  for (std::size_t n = 0; n < whole.size(); ++n)
    test::expect_error(ErrorCode::malformed, {"ends"}, [&] { read_packed_lobes(std::span(whole).first(n), 1, 16); });
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

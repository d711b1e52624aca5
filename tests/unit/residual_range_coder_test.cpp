// SPDX-License-Identifier: Apache-2.0
#include "residual/coefficient_model.h"
#include "residual/range_coder.h"
#include "residual/value_codes.h"
#include "support/brdfc_content.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace brdf::residual {
namespace {

using test::Lcg;

std::vector<bool> random_bits(std::size_t n, double p1, std::uint32_t seed) {
  Lcg random(seed);
  std::vector<bool> bits(n);
  for (std::size_t i = 0; i < n; ++i) bits[i] = random.unit() < p1;
  return bits;
}

std::vector<std::byte> encode_bits(const std::vector<bool>& bits, std::uint32_t p1 = 32768) {
  RangeEncoder coder;
  AdaptiveBit model(p1);
  for (const bool b : bits) coder.bit(model, b);
  return coder.finish();
}

void expect_same_bits(const std::vector<bool>& bits, std::span<const std::byte> bytes, std::uint32_t p1 = 32768) {
  RangeDecoder coder(bytes);
  AdaptiveBit model(p1);
  for (std::size_t i = 0; i < bits.size(); ++i)
    ASSERT_EQ(coder.bit(model), bits[i]) << "bit " << i << " of " << bits.size();
  EXPECT_LE(coder.overrun(), 4U) << "a decoder takes such a stream for damaged";
}

double entropy(double p) { return -(p * std::log2(p) + (1 - p) * std::log2(1 - p)); }

TEST(RangeCoder, GivesBackRandomBitsOfAnyBias) {
  for (const double p1 : {0.0, 0.001, 0.03, 0.5, 0.9, 0.999, 1.0})
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
      const auto bits = random_bits(seed * 37, p1, seed);
      expect_same_bits(bits, encode_bits(bits));
    }
}

// The decoder tells damage by how far it reads past the end, so no stream may end in more zeros than were cut off.
TEST(RangeCoder, ShortStreamsNeverOverrun) {
  for (std::uint32_t seed = 1; seed <= 6000; ++seed) {
    const auto bits = random_bits(seed % 150, 0.3, seed);
    expect_same_bits(bits, encode_bits(bits));
    if (testing::Test::HasFailure()) break;
  }
}

TEST(RangeCoder, StreamsOfOneBitValueNeverOverrun) {
  for (std::size_t n = 0; n < 3000; n += 7)
    for (const bool b : {false, true}) {
      const std::vector<bool> bits(n, b);
      expect_same_bits(bits, encode_bits(bits));
    }
}

// Bits that go against what the model has just learnt: the longest carries and the smallest ranges.
TEST(RangeCoder, GivesBackAdversarialBits) {
  RangeEncoder coder;
  AdaptiveBit model;
  std::vector<bool> bits;
  for (int i = 0; i < 4000; ++i) {
    const bool unlikely = model.p1() < 32768;
    const bool b = i % 50 < 45 ? !unlikely : unlikely;
    bits.push_back(b);
    coder.bit(model, b);
  }
  expect_same_bits(bits, coder.finish());
}

TEST(RangeCoder, GivesBackBitsUnderExtremeFixedProbabilities) {
  for (const std::uint32_t p1 : {1U, 2U, 327U, 65208U, 65534U, 65535U})
    for (const bool rare : {false, true}) {
      // a fresh model for each bit keeps the probability at its extreme
      RangeEncoder coder;
      std::vector<bool> bits;
      for (int i = 0; i < 300; ++i) {
        AdaptiveBit model(p1);
        bits.push_back((i % 9 == 0) == rare);
        coder.bit(model, bits.back());
      }
      const auto bytes = coder.finish();
      RangeDecoder decoder(bytes);
      for (std::size_t i = 0; i < bits.size(); ++i) {
        AdaptiveBit model(p1);
        ASSERT_EQ(decoder.bit(model), bits[i]) << p1 << " bit " << i;
      }
    }
}

TEST(RangeCoder, CarryRunsThroughPendingBytes) {
  // raw ones keep low just below a carry; the last bits push it over
  for (int ones = 8; ones < 80; ++ones) {
    RangeEncoder coder;
    for (int i = 0; i < ones; ++i) coder.raw(1, 1);
    AdaptiveBit model(60000);
    for (int i = 0; i < 12; ++i) coder.bit(model, i % 3 == 0);
    coder.raw(24, 0xFFFFFFU);
    const auto bytes = coder.finish();
    RangeDecoder decoder(bytes);
    for (int i = 0; i < ones; ++i) ASSERT_EQ(decoder.raw(1), 1U);
    AdaptiveBit twin(60000);
    for (int i = 0; i < 12; ++i) ASSERT_EQ(decoder.bit(twin), i % 3 == 0);
    ASSERT_EQ(decoder.raw(24), 0xFFFFFFU);
    EXPECT_LE(decoder.overrun(), 4U);
  }
}

TEST(RangeCoder, SizeIsNearTheEntropy) {
  for (const double p1 : {0.05, 0.2, 0.5, 0.9}) {
    constexpr std::size_t n = 40000;
    const double bits = 8.0 * static_cast<double>(encode_bits(random_bits(n, p1, 11)).size());
    const double ideal = n * entropy(p1);
    EXPECT_GT(bits, 0.97 * ideal) << p1;       // less would mean that something was lost
    EXPECT_LT(bits, 1.05 * ideal + 40) << p1;  // the rate of 1/43 never settles
  }
}

TEST(RangeCoder, RawBitsCostOneBitEach) {
  Lcg random(5);
  RangeEncoder coder;
  std::vector<std::uint32_t> values;
  for (int i = 0; i < 2000; ++i) values.push_back(random.next() >> (32 - 1 - i % 24));
  std::size_t bits = 0;
  for (int i = 0; i < 2000; ++i) {
    coder.raw(1 + i % 24, values[static_cast<std::size_t>(i)]);
    bits += static_cast<std::size_t>(1 + i % 24);
  }
  const auto bytes = coder.finish();
  EXPECT_LE(bytes.size(), bits / 8 + 2);
  RangeDecoder decoder(bytes);
  for (int i = 0; i < 2000; ++i) ASSERT_EQ(decoder.raw(1 + i % 24), values[static_cast<std::size_t>(i)]);
}

TEST(AdaptiveBit, IsNeverCertain) {
  for (const bool b : {false, true}) {
    AdaptiveBit model;
    for (int i = 0; i < 5000; ++i) model.update(b);
    EXPECT_GE(model.p1(), 327U);
    EXPECT_LE(model.p1(), 65535U - 327U);
  }
}

TEST(AdaptiveBit, FollowsTheFrequency) {
  AdaptiveBit model;
  const auto bits = random_bits(20000, 0.2, 3);
  double mean = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    model.update(bits[i]);
    if (i >= 1000) mean += model.p1() / 65536.0;
  }
  EXPECT_NEAR(mean / 19000, 0.2, 0.02);
}

TEST(AdaptiveBit, LearnsAsDocumented) {
  // docs/format.md: rates 65536 / (n + 3.5), rounded, for n below 16, then 65536 / (n + 3), n up to 40
  AdaptiveBit model(1000);
  std::int32_t p = 1000;
  for (int n = 0; n < 60; ++n) {
    const bool b = n % 3 != 0;
    const int seen = std::min(n, 40);
    const auto rate = seen < 16 ? static_cast<std::int32_t>(std::lround(65536 / (seen + 3.5))) : 65536 / (seen + 3);
    p += ((b ? 65208 : 327) - p) * rate / 65536;
    model.update(b);
    ASSERT_EQ(model.p1(), static_cast<std::uint32_t>(p)) << n;
  }
}

TEST(ValueCodes, CountsRoundTrip) {
  RangeEncoder coder;
  for (std::uint32_t v = 0; v < 32768; v += v < 300 ? 1 : 97) code_count(coder, v);
  code_count(coder, 32767);
  const auto bytes = coder.finish();
  RangeDecoder decoder(bytes);
  for (std::uint32_t v = 0; v < 32768; v += v < 300 ? 1 : 97) ASSERT_EQ(code_count(decoder, 0), v);
  EXPECT_EQ(code_count(decoder, 0), 32767U);
}

TEST(CoefficientModel, ValuesOfEveryMagnitudeRoundTrip) {
  std::vector<std::int32_t> values;
  for (std::int32_t v = 0; v <= 40; ++v) values.insert(values.end(), {v, -v});
  for (std::int32_t v = 64; v <= 1 << 20; v *= 2) values.insert(values.end(), {v - 1, -v, v + 1});
  values.push_back(-(1 << 20));
  for (int activity = 0; activity < activity_classes; ++activity) {
    RangeEncoder coder;
    CoefficientModel writer, reader;
    for (const std::int32_t v : values) EXPECT_EQ(writer.code(coder, true, activity, 2, v), v);
    const auto bytes = coder.finish();
    RangeDecoder decoder(bytes);
    for (const std::int32_t v : values) ASSERT_EQ(reader.code(decoder, true, activity, 2, 0), v);
  }
}

/// Adds up what a coder would spend.
struct BitMeter {
  double bits = 0;
  bool bit(AdaptiveBit& model, bool b) {
    bits -= std::log2((b ? model.p1() : 65536 - model.p1()) / 65536.0);
    model.update(b);
    return b;
  }
  std::uint32_t raw(int count, std::uint32_t v) {
    bits += count;
    return v;
  }
};

// Exact up to 5; beyond it one context serves every further step and learns on the way.
TEST(CoefficientModel, CostIsWhatTheCoderSpends) {
  CoefficientModel model;
  Lcg random(9);
  for (int i = 0; i < 3000; ++i) {
    const bool first = random.below(2) == 0;
    const auto activity = static_cast<int>(random.below(activity_classes)),
               radius = static_cast<int>(random.below(radius_classes));
    const auto v = static_cast<std::int32_t>(random.below(i % 3 == 0 ? 6 : 3)) * (random.below(2) == 0 ? 1 : -1);
    const double stated = model.cost(first, activity, radius, std::abs(v));
    BitMeter meter;
    model.code(meter, first, activity, radius, v);
    ASSERT_NEAR(stated, meter.bits, 1e-9) << v;
  }
}

}  // namespace
}  // namespace brdf::residual

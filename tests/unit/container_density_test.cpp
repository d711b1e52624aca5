// SPDX-License-Identifier: Apache-2.0
// Sampling tables in the file: what is written is read, and what is not sound is refused.
#include "container/density_codes.h"
#include "support/brdfc_content.h"
#include "support/expect_error.h"
#include "support/sampling_checks.h"
#include "support/small_measurement.h"

#include <brdf/encode.h>

#include <gtest/gtest.h>

#include <cmath>

namespace brdf::container {
namespace {

DensityCodes random_codes(std::uint32_t seed, std::size_t components, std::uint32_t range) {
  test::Lcg random(seed);
  DensityCodes codes;
  codes.level = EvalLevel::exact;
  codes.components.resize(components);
  for (auto& component : codes.components)
    for (std::size_t n = 0; n < density_nodes; ++n)
      component.push_back(static_cast<std::int16_t>(static_cast<int>(random.below(2 * range + 1)) - static_cast<int>(range)));
  if (components == 2)
    for (std::uint8_t& share : codes.second) share = static_cast<std::uint8_t>(random.below(256));
  return codes;
}

TEST(DensityCodes, WhatIsWrittenIsRead) {
  for (const std::size_t components : {std::size_t{1}, std::size_t{2}})
    for (const std::uint32_t range : {0U, 3U, 1600U}) {
      const DensityCodes codes = random_codes(range + 1, components, range), read = read_density(write_density(codes));
      EXPECT_EQ(read.level, codes.level);
      EXPECT_EQ(read.components, codes.components);
      EXPECT_EQ(read.second, codes.second);
    }
}

TEST(DensityCodes, BadHeadsAreMalformed) {
  const auto sound = write_density(random_codes(5, 2, 30));
  EXPECT_NO_THROW(check_density(sound, true));
  const auto refused = [&](const char* word, auto&& change) {
    auto bytes = sound;
    change(bytes);
    test::expect_error(ErrorCode::malformed, {"sampling chunk", word}, [&] { check_density(bytes, true); });
  };
  refused("head", [](auto& b) { b.resize(1); });
  refused("level 3", [](auto& b) { b[0] = std::byte{3}; });
  refused("0 components", [](auto& b) { b[1] = std::byte{0}; });
  refused("1 components", [](auto& b) { b[1] = std::byte{1}; });
  refused("3 components", [](auto& b) { b[1] = std::byte{3}; });
  refused("shares", [](auto& b) { b.resize(20); });
  refused("262144", [](auto& b) { b.resize(262145); });
  test::expect_error(ErrorCode::malformed, {"2 components", "1"}, [&] { check_density(sound, false); });
}

TEST(DensityCodes, AnyStreamIsADensity) {
  test::Lcg random(9);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::byte> payload{std::byte{1}, std::byte{1}};
    for (std::uint32_t n = random.below(3000); n > 0; --n) payload.push_back(static_cast<std::byte>(random.below(256)));
    const DensityCodes codes = read_density(payload);
    for (const std::int16_t code : codes.components.at(0)) ASSERT_LE(std::abs(code), largest_density_code);
  }
}

EncodeResult compressed(const Measurement& m, bool store, std::optional<std::uint64_t> size = {}) {
  EncodeOptions options;
  options.effort = 0;
  options.target_size = size;
  options.store_cdf = store;
  return compress(m, options);
}

TEST(StoredCdf, SamplesAsTheTablesThatAreBuilt) {
  for (const bool retro : {false, true}) {
    const LobeSet lobes{3, {{LobeKind::lambert, 1, 1, {0.2, 0.25, 0.1}}, {retro ? LobeKind::retro_ggx : LobeKind::ggx, 0.2, 0.5, {0.3, 0.3, 0.3}}}};
    const Measurement m = test::lobes_measurement(lobes, {45, 30, 36});
    const EncodeResult plain = compressed(m, false), stored = compressed(m, true);
    EXPECT_GT(stored.summary.cdf_bytes, 500U);
    const EncodeSummary& parts = stored.summary;
    EXPECT_EQ(stored.bytes.size(), parts.lobe_bytes + parts.residual_bytes + parts.cdf_bytes + parts.overhead_bytes);
    EXPECT_EQ(parts.lobe_bytes + parts.residual_bytes, plain.summary.lobe_bytes + plain.summary.residual_bytes);
    const Material built = Material::decode(plain.bytes), read = Material::decode(stored.bytes);
    for (const Vec3f& wo : test::sampling_views()) {
      SCOPED_TRACE(wo.z);
      test::expect_sampling(read, wo, 20000, 1e-5);
      const double deviation = test::weight_spread(read, wo).deviation, without = test::weight_spread(built, wo).deviation;
      EXPECT_LT(deviation, without + 0.03);
      // rounded codes: another density, if by little
      EXPECT_NE(read.pdf(wo, wo), built.pdf(wo, wo));
      EXPECT_NEAR(read.pdf(wo, wo), built.pdf(wo, wo), 0.05 * static_cast<double>(built.pdf(wo, wo)) + 1e-4);
    }
    // other levels build their own; values are the same
    const Vec3f wo = test::direction_at(0.6, 1), wi = test::direction_at(0.7, 2);
    EXPECT_EQ(read.prepare(EvalLevel::exact).pdf(wi, wo), built.prepare(EvalLevel::exact).pdf(wi, wo));
    std::vector<float> a(3), b(3);
    read.eval(wi, wo, a);
    built.eval(wi, wo, b);
    EXPECT_EQ(a, b);
  }
}

TEST(StoredCdf, CountsTowardsTheTargetSize) {
  const Measurement m = test::bumpy_measurement();
  const EncodeResult r = compressed(m, true, 9000);
  EXPECT_LE(r.bytes.size(), 9000U);
  EXPECT_EQ(r.bytes.size(), r.summary.bytes);
  EXPECT_GT(r.summary.residual_bytes, 100U);
  test::expect_error(ErrorCode::target_not_met, {"sampling tables", "400"}, [&] { compressed(m, true, 400); });
}

TEST(StoredCdf, OfOtherLobesIsMalformed) {
  const EncodeResult r = compressed(test::bumpy_measurement(), true);
  Content content = unpack(r.bytes, {}, false).content;
  content.sampling = write_density(random_codes(3, 2, 10));
  const auto bytes = pack(content);
  test::expect_error(ErrorCode::malformed, {"sampling chunk", "lobes"}, [&] { Material::decode(bytes); });
}

}  // namespace
}  // namespace brdf::container

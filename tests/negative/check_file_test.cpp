// SPDX-License-Identifier: Apache-2.0
// check_file foretells what decode and prepare do under any limits, and what their tables take.
#include "support/brdfc_content.h"
#include "support/golden_bytes.h"

#include <brdf/check.h>
#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace brdf {
namespace {

constexpr EvalLevel levels[] = {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact};

/// The sentence of the error that decoding at a level gives, or nothing.
std::string decode_at(std::span<const std::byte> bytes, EvalLevel level, const DecodeLimits& limits) {
  DecodeOptions options;
  options.level = level;
  options.limits = limits;
  try {
    (void)Material::decode(bytes, options);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

std::string foretold(const FileCheck& check, EvalLevel level) {
  if (check.problem) return check.problem->what();
  return check.at(level).problem ? check.at(level).problem->what() : "";
}

TEST(CheckFile, SaysWhatTheFileHolds) {
  container::Content content = test::layered_content();
  const auto bytes = container::pack(content);
  const FileCheck check = check_file(bytes);
  ASSERT_FALSE(check.problem);
  EXPECT_EQ(check.bytes, bytes.size());
  EXPECT_EQ(check.total_bytes, bytes.size());
  EXPECT_EQ(check.refinements_read, 3);
  EXPECT_EQ(check.refinements_total, 3);
  EXPECT_EQ(check.channels, 3);
  EXPECT_EQ(check.lobes, 3);
  const FileCheck cut = check_file(std::span(bytes).first(refinement_boundaries(bytes)[1]), {}, true);
  ASSERT_FALSE(cut.problem);
  EXPECT_EQ(cut.refinements_read, 1);
  EXPECT_EQ(cut.refinements_total, 3);
}

TEST(CheckFile, TableBytesAreThoseOfTheMaterial) {
  for (const test::GoldenFile& file : test::golden_files()) {
    const FileCheck check = check_file(file.bytes);
    ASSERT_FALSE(check.problem) << file.name;
    const Material m = Material::decode(file.bytes);
    EXPECT_EQ(check.sampling_bytes, m.sampling_bytes()) << file.name;
    const std::uint64_t lobes = m.prepare(EvalLevel::fast).resident_bytes();
    for (const EvalLevel level : levels) {
      EXPECT_TRUE(check.readable(level)) << file.name;
      EXPECT_EQ(check.at(level).table_bytes, m.prepare(level).resident_bytes() - lobes) << file.name << ' ' << to_string(level);
    }
  }
}

TEST(CheckFile, TheLastByteOfALimitDecides) {
  for (const test::GoldenFile& file : test::golden_files()) {
    const FileCheck plenty = check_file(file.bytes);
    for (const EvalLevel level : levels) {
      DecodeLimits limits;
      limits.max_table_bytes = plenty.at(level).table_bytes;
      limits.max_temporary_bytes = plenty.at(level).temporary_bytes;
      limits.max_file_bytes = file.bytes.size();
      EXPECT_EQ(foretold(check_file(file.bytes, limits), level), "") << file.name;
      EXPECT_EQ(decode_at(file.bytes, level, limits), "") << file.name;
      for (std::uint64_t DecodeLimits::*limit : {&DecodeLimits::max_table_bytes, &DecodeLimits::max_temporary_bytes, &DecodeLimits::max_file_bytes}) {
        DecodeLimits tight = limits;
        if (tight.*limit == 0) continue;
        --(tight.*limit);
        const std::string sentence = decode_at(file.bytes, level, tight);
        EXPECT_NE(sentence, "") << file.name << ' ' << to_string(level);
        EXPECT_NE(sentence.find(std::to_string(tight.*limit)), std::string::npos) << sentence;
        EXPECT_EQ(foretold(check_file(file.bytes, tight), level), sentence) << file.name;
      }
    }
  }
}

TEST(CheckFile, ForetellsDecodeUnderAnyLimits) {
  for (const test::GoldenFile& file : test::golden_files())
    for (std::uint64_t memory = 1; memory < (std::uint64_t{1} << 24); memory *= 4)
      for (std::uint64_t table = 1; table < (std::uint64_t{1} << 24); table *= 64) {
        DecodeLimits limits;
        limits.max_temporary_bytes = memory;
        limits.max_table_bytes = table;
        const FileCheck check = check_file(file.bytes, limits);
        for (const EvalLevel level : levels)
          ASSERT_EQ(foretold(check, level), decode_at(file.bytes, level, limits)) << file.name << ' ' << memory << ' ' << table;
      }
}

TEST(CheckFile, PrepareKeepsToTheLimitsOfDecode) {
  const auto bytes = container::pack(test::layered_content());
  const FileCheck plenty = check_file(bytes);
  DecodeOptions options;
  options.limits.max_table_bytes = plenty.at(EvalLevel::exact).table_bytes - 1;
  ASSERT_GT(options.limits.max_table_bytes, plenty.at(EvalLevel::balanced).table_bytes);
  const Material m = Material::decode(bytes, options);
  EXPECT_THROW((void)m.prepare(EvalLevel::exact), Error);
  EXPECT_EQ(check_file(bytes, options.limits).at(EvalLevel::exact).problem->code(), ErrorCode::limit_exceeded);
}

// No grid is built for slices at the exact level, so none may count: 195 channels are those of measured spectra.
TEST(CheckFile, AWideSpectrumInSlicesNeedsNoExactGrid) {
  container::Content c;
  c.component.channels = {ChannelModel::spectral, 195, {}};
  for (int i = 0; i < 195; ++i) c.component.channels.wavelengths_nm.push_back(static_cast<float>(360 + 3 * i));
  c.component.axes = container::AxesKind::slices;
  c.component.transform = residual::ChannelTransform::cosine;
  c.lobes = test::lobes_of_each_kind(195);
  c.residual = test::residual_of(195, false, {{40, false, std::vector<std::uint32_t>(195, 4)}});
  c.residual.slices.theta_i = {0, 20000, 50000};
  c.residual.slices.width = c.residual.slices.height = 8;
  c.residual.slices.rows = 8;
  c.residual.slices.ndf = {40, 30, 10, -20};
  c.residual.slices.ndf_step = 4;
  c.residual.slices.epsilon = 118;
  for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact}) c.errors.push_back({1, level, 0.1, 20});
  const auto bytes = container::pack(c);
  const FileCheck check = check_file(bytes);
  ASSERT_FALSE(check.problem) << check.problem->what();
  EXPECT_LT(check.at(EvalLevel::exact).table_bytes, 1U << 20);
  EXPECT_EQ(decode_at(bytes, EvalLevel::exact, {}), "");
}

}  // namespace
}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// Every truncation, every flipped bit and every changed byte of every golden file is an error, to decode and to check_file.
#include "support/golden_bytes.h"

#include <brdf/check.h>
#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace brdf {
namespace {

using test::golden_files;
using test::GoldenFile;

std::optional<Error> decode_error(std::span<const std::byte> bytes, bool allow_prefix) {
  DecodeOptions options;
  options.allow_prefix = allow_prefix;
  options.level = EvalLevel::fast;
  options.sampling = false;
  try {
    (void)Material::decode(bytes, options);
  } catch (const Error& e) {
    return e;
  }
  return std::nullopt;
}

/// Whether both refuse the bytes, for the same reason.
testing::AssertionResult refused(std::span<const std::byte> bytes, bool allow_prefix) {
  const std::optional<Error> error = decode_error(bytes, allow_prefix), found = check_file(bytes, {}, allow_prefix).problem;
  if (!error) return testing::AssertionFailure() << "decoded";
  if (!found) return testing::AssertionFailure() << "check_file found nothing, decode: " << error->what();
  if (found->code() != error->code() || std::string(found->what()) != error->what())
    return testing::AssertionFailure() << "check_file: " << found->what() << "; decode: " << error->what();
  return testing::AssertionSuccess();
}

TEST(Exhaustive, GoldenFilesAreSound) {
  ASSERT_GE(golden_files().size(), 8U);
  for (const GoldenFile& file : golden_files()) EXPECT_FALSE(check_file(file.bytes).problem) << file.name;
}

TEST(Exhaustive, EveryTruncationIsAnErrorButAtABoundaryOnDemand) {
  for (const GoldenFile& file : golden_files()) {
    const std::vector<std::uint64_t> ends = refinement_boundaries(file.bytes);
    std::size_t opened = 0;
    for (std::size_t n = 0; n < file.bytes.size(); ++n) {
      const auto prefix = std::span(file.bytes).first(n);
      ASSERT_TRUE(refused(prefix, false)) << file.name << " cut at " << n;
      const auto end = std::find(ends.begin(), ends.end(), n);
      if (end == ends.end()) {
        ASSERT_TRUE(refused(prefix, true)) << file.name << " cut at " << n;
        continue;
      }
      const FileCheck check = check_file(prefix, {}, true);
      ASSERT_FALSE(check.problem) << file.name << " cut at " << n << ": " << check.problem->what();
      ASSERT_FALSE(decode_error(prefix, true)) << file.name << " cut at " << n;
      EXPECT_EQ(check.refinements_read, end - ends.begin());
      EXPECT_EQ(check.total_bytes, file.bytes.size());
      ++opened;
    }
    // provenance may follow the last boundary
    EXPECT_EQ(opened, ends.back() == file.bytes.size() ? ends.size() - 1 : ends.size()) << file.name;
  }
}

TEST(Exhaustive, EveryFlippedBitIsAnError) {
  for (const GoldenFile& file : golden_files()) {
    std::vector<std::byte> bytes = file.bytes;
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      const auto flip = static_cast<std::byte>(1U << (bit % 8));
      bytes[bit / 8] ^= flip;
      for (const bool allow_prefix : {false, true})
        ASSERT_TRUE(refused(bytes, allow_prefix)) << file.name << " bit " << bit % 8 << " of byte " << bit / 8;
      bytes[bit / 8] ^= flip;
    }
    ASSERT_EQ(bytes, file.bytes);
  }
}

TEST(Exhaustive, EveryChangedByteIsAnError) {
  for (const GoldenFile& file : golden_files()) {
    std::vector<std::byte> bytes = file.bytes;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      const std::byte sound = bytes[at];
      for (unsigned value = 0; value < 256; ++value) {
        bytes[at] = static_cast<std::byte>(value);
        if (bytes[at] == sound) continue;
        ASSERT_TRUE(check_file(bytes).problem) << file.name << " byte " << at << " is " << value;
      }
      bytes[at] = sound;
    }
  }
}

TEST(Exhaustive, TwoFilesOneAfterTheOtherAreNone) {
  for (const GoldenFile& file : golden_files()) {
    std::vector<std::byte> twice = file.bytes;
    twice.insert(twice.end(), file.bytes.begin(), file.bytes.end());
    EXPECT_TRUE(refused(twice, false)) << file.name;
    EXPECT_TRUE(refused(twice, true)) << file.name;
  }
}

}  // namespace
}  // namespace brdf

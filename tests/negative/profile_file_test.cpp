// SPDX-License-Identifier: Apache-2.0
// Profile files that nobody wrote: every truncation, every changed bit, and fields that mean nothing under a sound checksum.
#include "base/byte_reader.h"
#include "base/hash.h"
#include "support/expect_error.h"

#include <brdf/profile.h>
#include <gtest/gtest.h>

#include <cstring>

namespace brdf {
namespace {

std::vector<std::byte> sound_file() {
  ProfileRecorder r({"far", "near"});
  r.record(0, ProfileOperation::eval, {0.6F, 0, 0.8F}, {0, 0.6F, 0.8F}, 0.5);
  r.record(1, ProfileOperation::sample, {0, 0, 1}, {-0.6F, 0, 0.8F}, 2.5);
  r.record(1, ProfileOperation::pdf, {0, 0.28F, 0.96F}, {0, -0.28F, 0.96F}, 1e6);
  r.first_hit(1, 0.25);
  return r.profile().write();
}

/// The same with the checksum that belongs to it.
std::vector<std::byte> sealed(std::vector<std::byte> bytes) {
  const std::span all(bytes);
  base::store_little_endian(base::xxh32(all.first(all.size() - 4)), all.last(4));
  return bytes;
}

std::vector<std::byte> file_of(std::initializer_list<int> body, std::size_t zeros = 0) {
  std::vector<std::byte> bytes;
  for (const char c : {'B', 'R', 'P', 'F'}) bytes.push_back(static_cast<std::byte>(c));
  for (const int b : {1, 48, 24, 12, 16, 18}) bytes.push_back(static_cast<std::byte>(b));
  for (const int b : body) bytes.push_back(static_cast<std::byte>(b));
  bytes.resize(bytes.size() + zeros + 4);
  return sealed(std::move(bytes));
}

constexpr std::size_t sums = 8 + 16 + 18 + 18;  // numbers of a material before its cells, one byte each where 0

TEST(ProfileFile, EveryTruncationIsRefused) {
  const std::vector<std::byte> bytes = sound_file();
  EXPECT_NO_THROW(Profile::read(bytes));
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_THROW(Profile::read(std::span(bytes).first(n)), Error) << n;
}

TEST(ProfileFile, EveryChangedBitIsRefused) {
  std::vector<std::byte> bytes = sound_file();
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const auto mask = static_cast<std::byte>(1U << (bit % 8));
    bytes[bit / 8] ^= mask;
    EXPECT_THROW(Profile::read(bytes), Error) << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST(ProfileFile, WhatFollowsTheEndIsRefused) {
  std::vector<std::byte> bytes = sound_file();
  bytes.insert(bytes.end() - 4, std::byte{0});
  test::expect_error(ErrorCode::malformed, {"1 bytes follow"}, [&] { Profile::read(sealed(bytes)); });
}

TEST(ProfileFile, SaysWhatItIsNot) {
  test::expect_error(ErrorCode::not_recognized, {"BRPF"}, [] { Profile::read({}); });
  test::expect_error(ErrorCode::not_recognized, {"BRPF"}, [] { Profile::read(std::as_bytes(std::span("OBJ ", 4))); });
  std::vector<std::byte> bytes = sound_file();
  bytes[4] = std::byte{2};
  test::expect_error(ErrorCode::unsupported, {"version 2"}, [&] { Profile::read(sealed(bytes)); });
  bytes[4] = std::byte{1};
  bytes[5] = std::byte{47};
  test::expect_error(ErrorCode::unsupported, {"47 theta_h bins", "48"}, [&] { Profile::read(sealed(bytes)); });
}

TEST(ProfileFile, FieldsThatMeanNothingAreRefused) {
  const auto refused = [](ErrorCode code, const char* word, const std::vector<std::byte>& file) {
    test::expect_error(code, {word}, [&] { Profile::read(file); });
  };
  EXPECT_TRUE(Profile::read(file_of({0})).materials.empty());
  EXPECT_EQ(Profile::read(file_of({1, 1, 'a'}, sums + 1)).materials.size(), 1U);
  refused(ErrorCode::malformed, "shortest form", file_of({0x80, 0}));
  refused(ErrorCode::malformed, "shortest form", file_of({0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 2}));
  refused(ErrorCode::limit_exceeded, "2000 materials", file_of({0xD0, 0x0F}));
  refused(ErrorCode::limit_exceeded, "name of 256 bytes", file_of({1, 0x80, 2}, 400));
  refused(ErrorCode::truncated, "a name", file_of({1, 9, 'a'}));
  refused(ErrorCode::malformed, "empty or holds", file_of({1, 0}, sums + 1));
  refused(ErrorCode::malformed, "empty or holds", file_of({1, 1, 7}, sums + 1));
  refused(ErrorCode::truncated, "marginal of theta_o", file_of({1, 1, 'a'}, sums - 1));
}

TEST(ProfileFile, NamesAscend) {
  std::vector<std::byte> twice = file_of({2, 1, 'a'}, sums + 1);
  twice.resize(twice.size() - 4);
  for (const char c : {'\x01', 'a'}) twice.push_back(static_cast<std::byte>(c));
  twice.resize(twice.size() + sums + 1 + 4);
  test::expect_error(ErrorCode::malformed, {"do not ascend"}, [&] { Profile::read(sealed(twice)); });
}

TEST(ProfileFile, CellsAreListedOnceWithinTheGrid) {
  const auto with_cells = [](std::initializer_list<int> cells, float least = 0, float most = 1) {
    std::vector<std::byte> bytes = file_of({1, 1, 'a'}, sums);
    bytes.resize(bytes.size() - 4);
    bytes.push_back(static_cast<std::byte>(1));
    for (const float v : {least, most, 0.0F, 1.0F}) {
      std::byte raw[4];
      base::store_little_endian(v, std::span<std::byte>(raw));
      bytes.insert(bytes.end(), raw, raw + 4);
    }
    for (const int b : cells) bytes.push_back(static_cast<std::byte>(b));
    bytes.resize(bytes.size() + 4);
    return sealed(std::move(bytes));
  };
  EXPECT_EQ(Profile::read(with_cells({0xFF, 0x6B, 5})).at("a").histogram[13823], 5U);
  test::expect_error(ErrorCode::malformed, {"beyond the last"}, [&] { Profile::read(with_cells({0x80, 0x6C, 5})); });
  test::expect_error(ErrorCode::malformed, {"without any contribution"}, [&] { Profile::read(with_cells({3, 0})); });
  test::expect_error(ErrorCode::malformed, {"range of theta_i"}, [&] { Profile::read(with_cells({3, 1}, 1, 0)); });
  test::expect_error(ErrorCode::malformed, {"range of theta_i"}, [&] { Profile::read(with_cells({3, 1}, 0, 2)); });
  test::expect_error(ErrorCode::malformed, {"range of theta_i"}, [&] { Profile::read(with_cells({3, 1}, std::numeric_limits<float>::quiet_NaN(), 1)); });
}

TEST(ProfileFile, LimitsAreThoseOfTheCaller) {
  const std::vector<std::byte> bytes = sound_file();
  test::expect_error(ErrorCode::limit_exceeded, {"at most 10"}, [&] { Profile::read(bytes, {10, 1024, 255}); });
  test::expect_error(ErrorCode::limit_exceeded, {"2 materials", "at most 1"}, [&] { Profile::read(bytes, {1 << 20, 1, 255}); });
}

TEST(ProfileFile, NamesThatNoFileMayHoldAreRefused) {
  for (const std::string& name : {std::string(), std::string("a\nb"), std::string(256, 'x')}) {
    Profile p;
    p.materials[name];
    test::expect_error(ErrorCode::invalid_argument, {"no name of a slot"}, [&] { static_cast<void>(p.write()); });
  }
}

}  // namespace
}  // namespace brdf

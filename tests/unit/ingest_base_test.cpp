// SPDX-License-Identifier: Apache-2.0
// Size arithmetic, the byte reader and whole files, on which every reader rests.
#include "base/byte_reader.h"
#include "base/checked.h"
#include "base/file_io.h"
#include "base/hash.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>

namespace brdf::base {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t top = std::numeric_limits<std::uint64_t>::max();

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// An empty folder that goes away with the test.
class BaseFile : public testing::Test {
 protected:
  BaseFile() {
    std::string name = (fs::temp_directory_path() / "brdf-base-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no folder for temporary files");
    folder_ = name;
  }
  ~BaseFile() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

TEST(BaseChecked, ArithmeticStopsAtTheLargestNumber) {
  EXPECT_EQ(checked_add(top - 1, 1), top);
  EXPECT_EQ(checked_add(top, 1), std::nullopt);
  EXPECT_EQ(checked_multiply(top / 3, 3), top);
  EXPECT_EQ(checked_multiply(top / 3 + 1, 3), std::nullopt);
  EXPECT_EQ(checked_multiply(top, 0), 0u);
  EXPECT_EQ(checked_product(std::array<std::uint64_t, 3>{2, 3, 7}), 42u);
  EXPECT_EQ(checked_product({}), 1u);
  EXPECT_EQ(checked_product(std::array<std::uint64_t, 3>{std::uint64_t{1} << 32, std::uint64_t{1} << 32, 1}),
            std::nullopt);
}

TEST(BaseChecked, RangesAreCheckedWithoutWrappingAround) {
  EXPECT_TRUE(range_fits(0, 10, 10));
  EXPECT_TRUE(range_fits(10, 0, 10));
  EXPECT_FALSE(range_fits(10, 1, 10));
  EXPECT_FALSE(range_fits(11, 0, 10));
  EXPECT_FALSE(range_fits(top, 2, 10));
  EXPECT_FALSE(range_fits(2, top, 10));
}

TEST(BaseByteReader, ReadsLittleEndianAndStopsAtTheEnd) {
  const auto bytes = bytes_of(std::string("\x01\x02\x03\x04\0\0\x80\x3f\xff", 9));
  ByteReader reader(bytes, "file");
  EXPECT_EQ(reader.read<std::uint32_t>("number"), 0x04030201u);
  EXPECT_EQ(reader.read<float>("number"), 1.0f);
  EXPECT_EQ(reader.position(), 8u);
  test::expect_error(ErrorCode::truncated, {"file", "the tail", "9 bytes"},
                     [&] { reader.read<std::uint16_t>("the tail"); });
  EXPECT_EQ(reader.remaining(), 1u);
  test::expect_error(ErrorCode::truncated, {"18446744073709551615"}, [&] { reader.take(top, "the tail"); });
  EXPECT_EQ(reader.read<std::int8_t>("number"), -1);
}

TEST(BaseByteReader, StoresWhatItLoads) {
  std::array<std::byte, 8> raw{};
  store_little_endian(-2.5, std::span(raw));
  EXPECT_EQ(raw[7], std::byte{0xc0});
  EXPECT_EQ(load_little_endian<double>(raw), -2.5);
}

TEST(BaseHash, IsThePublishedFunction) {
  EXPECT_EQ(xxh3_64({}), 0x2d06800538d394c2u);  // of nothing, as in the XXH3 specification
  EXPECT_NE(xxh3_64(bytes_of("a")), xxh3_64(bytes_of("b")));
}

TEST_F(BaseFile, WhatIsWrittenIsRead) {
  const fs::path path = folder_ / "a.bin";
  write_file_atomically(path, bytes_of("hello"), false);
  EXPECT_EQ(read_file(path, 5), bytes_of("hello"));
  write_file_atomically(path, {}, true);
  EXPECT_TRUE(read_file(path, 0).empty());
  EXPECT_EQ(files(), 1u);
}

TEST_F(BaseFile, NothingIsOverwrittenUnasked) {
  const fs::path path = folder_ / "a.bin";
  write_file_atomically(path, bytes_of("old"), false);
  test::expect_error(ErrorCode::io, {"a.bin", "exists already"},
                     [&] { write_file_atomically(path, bytes_of("new"), false); });
  EXPECT_EQ(text_of(path), "old");
  write_file_atomically(path, bytes_of("new"), true);
  EXPECT_EQ(text_of(path), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(BaseFile, ANewFileHasTheUsualPermissions) {
  const ::mode_t mask = ::umask(027);
  write_file_atomically(folder_ / "a.bin", bytes_of("x"), false);
  ::umask(mask);
  EXPECT_EQ(fs::status(folder_ / "a.bin").permissions(), fs::perms(0640));
}

TEST_F(BaseFile, ASymbolicLinkIsFollowed) {
  write_file_atomically(folder_ / "real", bytes_of("old"), false);
  fs::create_symlink("real", folder_ / "link");
  write_file_atomically(folder_ / "link", bytes_of("new"), true);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(text_of(folder_ / "real"), "new");
}

TEST_F(BaseFile, WritingSaysWhyItFailed) {
  test::expect_error(ErrorCode::io, {"nowhere", "No such file or directory"},
                     [&] { write_file_atomically(folder_ / "nowhere" / "a", bytes_of("x"), true); });
  test::expect_error(ErrorCode::io, {"is a directory"}, [&] { write_file_atomically(folder_, bytes_of("x"), true); });
  if (fs::exists("/dev/full")) {
    test::expect_error(ErrorCode::io, {"/dev/full", "No space left"},
                       [&] { write_file_atomically("/dev/full", bytes_of("x"), true); });
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(BaseFile, ReadingSaysWhyItFailed) {
  test::expect_error(ErrorCode::io, {"missing", "No such file or directory"},
                     [&] { read_file(folder_ / "missing", 10); });
  test::expect_error(ErrorCode::io, {"is a directory"}, [&] { read_file(folder_, 10); });
  write_file_atomically(folder_ / "big", bytes_of("0123456789"), false);
  test::expect_error(ErrorCode::limit_exceeded, {"big", "10 bytes", "limit is 9"},
                     [&] { read_file(folder_ / "big", 9); });
}

TEST_F(BaseFile, APipeIsReadToItsEndUnderTheLimit) {
  if (!fs::exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero";
  EXPECT_TRUE(read_file("/dev/null", 10).empty());
  test::expect_error(ErrorCode::limit_exceeded, {"/dev/zero", "more than 100000"},
                     [&] { read_file("/dev/zero", 100000); });
}

TEST_F(BaseFile, UnreadableFilesAreNamed) {
  if (::geteuid() == 0) GTEST_SKIP() << "permissions do not bind the superuser";
  write_file_atomically(folder_ / "secret", bytes_of("x"), false);
  fs::permissions(folder_ / "secret", fs::perms::none);
  test::expect_error(ErrorCode::io, {"secret", "Permission denied"}, [&] { read_file(folder_ / "secret", 10); });
}

}  // namespace
}  // namespace brdf::base

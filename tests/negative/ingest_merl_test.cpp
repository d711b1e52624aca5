// SPDX-License-Identifier: Apache-2.0
// Bad MERL files, and files that are none.
#include <brdf/ingest.h>

#include "ingest/merl_reader.h"
#include "ingest/merl_writer.h"
#include "support/expect_error.h"
#include "support/merl_bytes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brdf {
namespace {

using test::expect_error;

std::vector<std::byte> from_text(const std::string& text) {
  std::vector<std::byte> bytes;
  test::append_text(bytes, text);
  return bytes;
}

void expect_refused(ErrorCode code, std::initializer_list<const char*> words, const std::vector<std::byte>& bytes,
                    const IngestOptions& options = {}) {
  expect_error(code, words, [&] { read_measurement(bytes, "bad.binary", options); });
}

TEST(BadMerl, Empty) { expect_refused(ErrorCode::truncated, {"bad.binary", "empty"}, {}); }

TEST(BadMerl, Truncated) {
  auto bytes = test::merl_header({90, 90, 180});
  bytes.resize(1000);
  expect_refused(ErrorCode::truncated, {"bad.binary", "34992012", "1000"}, bytes);
}

TEST(BadMerl, TruncatedByOneByte) {
  auto bytes = test::merl_bytes(180, [](int, int, int, int) { return 1.0; });
  bytes.pop_back();
  expect_refused(ErrorCode::truncated, {"34992012", "34992011"}, bytes);
}

TEST(BadMerl, OneByteTooLong) {
  auto bytes = test::merl_bytes(180, [](int, int, int, int) { return 1.0; });
  bytes.push_back(std::byte{0});
  expect_refused(ErrorCode::malformed, {"34992012", "34992013"}, bytes);
}

TEST(BadMerl, HeaderOnlyOfTheFullCircle) {
  expect_refused(ErrorCode::truncated, {"69984012", "12"}, test::merl_header({90, 90, 360}));
}

TEST(BadMerl, WrongDimensionsInAFileOfTheRightSize) {
  auto bytes = test::merl_bytes(180, [](int, int, int, int) { return 1.0; });
  base::store_little_endian(std::int32_t{91}, std::span(bytes));
  expect_refused(ErrorCode::malformed, {"bad.binary", "91 x 90 x 180", "90 x 90 x 180"}, bytes);
}

TEST(BadMerl, NegativeDimensionsWhoseProductFits) {
  auto bytes = test::merl_header({-90, -90, 180});
  const IngestOptions options;
  expect_error(ErrorCode::malformed, {"-90 x -90 x 180"}, [&] { ingest::read_merl(bytes, "bad.binary", options); });
}

TEST(BadMerl, DimensionsWhoseProductWrapsAround) {
  // 2^32 / 180 rounded so that a 32-bit product would wrap; and the largest numbers
  for (const std::array<std::int32_t, 3>& n :
       {std::array<std::int32_t, 3>{0x7fffffff, 0x7fffffff, 180}, std::array<std::int32_t, 3>{65536, 65536, 360},
        std::array<std::int32_t, 3>{16384, 16384, 180}}) {
    const auto bytes = test::merl_header(n);
    expect_error(ErrorCode::malformed, {"MERL bin counts"}, [&] { ingest::read_merl(bytes, "bad.binary", {}); });
    expect_refused(ErrorCode::not_recognized, {"bad.binary"}, bytes);
  }
}

TEST(BadMerl, SwappedDimensions) {
  expect_refused(ErrorCode::not_recognized, {"5a 00 00 00"}, test::merl_header({90, 180, 90}));
}

TEST(BadMerl, ShorterThanItsHeader) {
  const auto bytes = from_text(std::string("\x5a\0\0\0\x5a", 5));
  expect_error(ErrorCode::truncated, {"bin counts", "5 bytes"}, [&] { ingest::read_merl(bytes, "bad.binary", {}); });
}

TEST(BadMerl, EveryCellInvalid) {
  expect_refused(ErrorCode::no_data, {"none of the 1458000 cells"},
                 test::merl_bytes(180, [](int, int, int, int) { return -1.0; }));
}

TEST(BadMerl, NanEverywhere) {
  expect_refused(ErrorCode::no_data, {"none of the 1458000 cells"},
                 test::merl_bytes(180, [](int, int, int, int) { return std::nan(""); }));
}

TEST(BadMerl, EachCellLacksOneChannel) {
  expect_refused(ErrorCode::no_data, {"three finite values"},
                 test::merl_bytes(180, [](int c, int, int, int k) { return c == k % 3 ? -1.0 : 1.0; }));
}

TEST(BadMerl, LargerThanTheLimits) {
  const auto bytes = test::merl_bytes(180, [](int, int, int, int) { return 1.0; });
  IngestOptions options;
  options.limits.max_file_bytes = bytes.size() - 1;
  expect_refused(ErrorCode::limit_exceeded, {"34992012", "34992011"}, bytes, options);
  options = {};
  options.limits.max_table_values = 4373999;
  expect_refused(ErrorCode::limit_exceeded, {"4374000", "4373999"}, bytes, options);
  options = {};
  options.limits.max_temporary_bytes = 4 * 4374000 + 1458000 - 1;  // three floats and a flag for each cell
  expect_refused(ErrorCode::limit_exceeded, {"18954000", "18953999"}, bytes, options);
  options = {};
  options.limits.max_channels = 2;
  expect_refused(ErrorCode::limit_exceeded, {"3 channels", "limit is 2"}, bytes, options);
}

TEST(NoMeasuredFile, GitLfsPointer) {
  expect_refused(ErrorCode::not_recognized, {"bad.binary", "Git-LFS pointer"},
                 from_text("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 34992012\n"));
}

TEST(NoMeasuredFile, Text) {
  expect_refused(ErrorCode::not_recognized, {"is a text file"}, from_text("<html>404 not found</html>\r\n"));
}

TEST(NoMeasuredFile, CompressedMaterial) {
  expect_refused(ErrorCode::not_recognized, {"compressed material"}, from_text(std::string("BRFC\0\0\0\0", 8)));
}

TEST(NoMeasuredFile, UnknownBytesAreShown) {
  expect_refused(ErrorCode::not_recognized, {"89 50 4e 47"}, from_text("\x89PNG\r\n\x1a\n"));
}

TEST(NoMeasuredFile, MissingFileAndFolder) {
  expect_error(ErrorCode::io, {"/nonexistent/x.binary", "No such file"},
               [] { read_measurement(std::filesystem::path("/nonexistent/x.binary")); });
  expect_error(ErrorCode::io, {"is a directory"}, [] { read_measurement(std::filesystem::temp_directory_path()); });
}

TEST(BadMerlWrite, TableThatTheFormatCannotHold) {
  HalfDifferenceTable t;
  t.n_theta_h = 90;
  t.n_theta_d = 90;
  t.n_phi_d = 90;
  expect_error(ErrorCode::invalid_argument, {"90 x 90 x 90"}, [&] { ingest::write_merl(t); });
  t.n_phi_d = 180;
  expect_error(ErrorCode::invalid_argument, {"0 values", "1458000"}, [&] { ingest::write_merl(t); });
  t.valid.assign(1458000, 1);
  t.values.assign(3 * 1458000, 1.0f);
  t.full_circle = true;
  expect_error(ErrorCode::invalid_argument, {"over 2 pi"}, [&] { ingest::write_merl(t); });
  t.full_circle = false;
  t.values[301] = -0.5f;
  expect_error(ErrorCode::invalid_argument, {"cell 100", "-0.5"}, [&] { ingest::write_merl(t); });
  t.valid[100] = 0;
  EXPECT_EQ(ingest::write_merl(t).size(), 34992012u);
}

}  // namespace
}  // namespace brdf

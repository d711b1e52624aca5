// SPDX-License-Identifier: Apache-2.0
// EXR files from strangers: other layouts are read, broken ones refused with one sentence.
#include "image/image_file.h"
#include "support/exr_builder.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

#include <fstream>
#include <random>

namespace brdf::render {
namespace {

using test::ExrBytes;
using test::ExrHeader;
using test::expect_error;
using test::TemporaryFolder;
using test::uncompressed_exr;
using test::write_bytes;

float numbered(const std::string& channel, std::int64_t x, std::int64_t y) {
  return static_cast<float>(channel[0]) + 0.5F * static_cast<float>(x) + 100.0F * static_cast<float>(y);
}

std::string one_sentence(const std::filesystem::path& path) {
  try {
    read_image(path);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(ExrReader, LeavesBlackWhatTheDataWindowDoesNotCover) {
  const TemporaryFolder folder;
  ExrHeader header;
  header.display = {10, 20, 15, 24};
  header.data = {12, 18, 17, 22};  // two rows above the display, two columns beyond it
  write_bytes(folder / "a.exr", uncompressed_exr(header, numbered));
  const Image image = read_image(folder / "a.exr");
  ASSERT_EQ(image.width, 6);
  ASSERT_EQ(image.height, 5);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      const bool inside = x >= 2 && y <= 2;
      EXPECT_EQ(image.at(x, y), inside ? Vec3f(numbered("R", x + 10, y + 20), numbered("G", x + 10, y + 20), numbered("B", x + 10, y + 20)) : Vec3f(0)) << x << " " << y;
    }
  }
}

TEST(ExrReader, WindowsThatDoNotMeetGiveBlack) {
  const TemporaryFolder folder;
  ExrHeader header;
  header.data = {-1000000, 5, -999997, 6};
  write_bytes(folder / "a.exr", uncompressed_exr(header, numbered));
  const Image image = read_image(folder / "a.exr");
  EXPECT_EQ(image.pixels, std::vector<Vec3f>(8, Vec3f(0)));
}

TEST(ExrReader, LuminanceAloneIsGrey) {
  const TemporaryFolder folder;
  ExrHeader header;
  header.channels = {{"A"}, {"Y"}, {"Z"}};
  write_bytes(folder / "a.exr", uncompressed_exr(header, numbered));
  EXPECT_EQ(read_image(folder / "a.exr").at(3, 1), Vec3f(numbered("Y", 3, 1)));
}

TEST(ExrReader, KnowsTheFormatByItsContent) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.png", uncompressed_exr(ExrHeader(), numbered));
  EXPECT_EQ(read_image(folder / "a.png").width, 4);
  write_bytes(folder / "b.exr", "\x89PNG\r\n and more");
  expect_error(ErrorCode::not_recognized, {"b.exr", "not an OpenEXR file"}, [&] { read_image(folder / "b.exr"); });
  write_bytes(folder / "empty.exr", "");
  expect_error(ErrorCode::not_recognized, {"empty.exr"}, [&] { read_image(folder / "empty.exr"); });
  expect_error(ErrorCode::io, {"missing.exr"}, [&] { read_image(folder / "missing.exr"); });
}

TEST(ExrReader, RefusesWindowsWithoutPixelsAndHugeOnes) {
  const TemporaryFolder folder;
  const auto refuses = [&](const test::ExrWindow& data, const test::ExrWindow& display, ErrorCode code, std::initializer_list<const char*> words) {
    ExrHeader header;
    header.data = data;
    header.display = display;
    write_bytes(folder / "a.exr", header.bytes() + std::string(64, '\0'));
    expect_error(code, words, [&] { read_image(folder / "a.exr"); });
  };
  refuses({0, 0, 40000, 1}, {0, 0, 3, 3}, ErrorCode::limit_exceeded, {"a.exr", "data window", "40001 x 2"});
  refuses({0, 0, 3, 3}, {0, 0, 3, 40000}, ErrorCode::limit_exceeded, {"display window"});
  refuses({0, 0, 32767, 32767}, {0, 0, 32767, 32767}, ErrorCode::limit_exceeded, {"32768 x 32768"});
  refuses({0, 0, 1000000000, 1000000000}, {0, 0, 3, 3}, ErrorCode::limit_exceeded, {"data window"});
  refuses({3, 0, 0, 3}, {0, 0, 3, 3}, ErrorCode::malformed, {"a.exr"});
  refuses({-2147483647 - 1, 0, 2147483647, 3}, {0, 0, 3, 3}, ErrorCode::malformed, {"a.exr"});
}

TEST(ExrReader, LimitsAreTheCallers) {
  const TemporaryFolder folder;
  write_exr(Image(64, 32), folder / "a.exr");
  ReadLimits limits;
  limits.max_side = 63;
  expect_error(ErrorCode::limit_exceeded, {"64 x 32"}, [&] { read_image(folder / "a.exr", limits); });
  limits = {};
  limits.max_pixels = 2047;
  expect_error(ErrorCode::limit_exceeded, {"2047"}, [&] { read_image(folder / "a.exr", limits); });
  limits = {};
  limits.max_file_bytes = 100;
  expect_error(ErrorCode::limit_exceeded, {"a.exr"}, [&] { read_image(folder / "a.exr", limits); });
}

TEST(ExrReader, RefusesChannelsThatAreNoPicture) {
  const TemporaryFolder folder;
  const auto refuses = [&](std::vector<test::ExrChannel> channels, std::initializer_list<const char*> words) {
    ExrHeader header;
    header.channels = std::move(channels);
    write_bytes(folder / "a.exr", uncompressed_exr(header, numbered));
    expect_error(ErrorCode::unsupported, words, [&] { read_image(folder / "a.exr"); });
  };
  refuses({{"B"}, {"R"}}, {"neither channels R, G and B nor Y"});
  refuses({{"Z"}}, {"neither channels"});
  refuses({{"BY"}, {"RY"}, {"Y"}}, {"neither channels"});
  refuses({{"B"}, {"G", 0}, {"R"}}, {"channel G", "neither half nor float"});
  refuses({{"B"}, {"G"}, {"R", 2, 2, 1}}, {"channel R", "subsampled"});
}

TEST(ExrReader, RefusesOtherPrimariesPartsAndVersions) {
  const TemporaryFolder folder;
  ExrHeader header;
  header.more = ExrBytes().attribute("chromaticities", "chromaticities",
      ExrBytes().f32(0.713F).f32(0.293F).f32(0.165F).f32(0.830F).f32(0.128F).f32(0.044F).f32(0.32168F).f32(0.33767F).bytes()).bytes();
  write_bytes(folder / "aces.exr", uncompressed_exr(header, numbered));
  expect_error(ErrorCode::unsupported, {"aces.exr", "primaries"}, [&] { read_image(folder / "aces.exr"); });
  for (const unsigned version : {1U, 3U, 2U | 0x800U, 2U | 0x1000U, 2U | 0x8000U}) {
    ExrHeader other;
    other.version = version;
    write_bytes(folder / "a.exr", uncompressed_exr(other, numbered));
    expect_error(ErrorCode::unsupported, {"a.exr"}, [&] { read_image(folder / "a.exr"); });
  }
}

TEST(ExrReader, RefusesValuesThatAreNotFiniteWithTheirPixel) {
  const TemporaryFolder folder;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    write_bytes(folder / "a.exr", uncompressed_exr(ExrHeader(), [&](const std::string& c, std::int64_t x, std::int64_t y) {
                  return c == "G" && x == 2 && y == 1 ? bad : 1.0F;
                }));
    expect_error(ErrorCode::malformed, {"a.exr", "(2, 1)", "finite"}, [&] { read_image(folder / "a.exr"); });
  }
}

TEST(ExrReader, RefusesAttributesLargerThanTheFile) {
  const TemporaryFolder folder;
  ExrHeader header;
  header.more = ExrBytes().text("comment").text("string").i32(2000000000).bytes();
  write_bytes(folder / "a.exr", header.bytes());
  expect_error(ErrorCode::truncated, {"a.exr", "'comment'", "2000000000"}, [&] { read_image(folder / "a.exr"); });
  header.more = ExrBytes().text(std::string(300, 'x')).bytes();
  write_bytes(folder / "a.exr", header.bytes() + std::string(300, '\0'));
  expect_error(ErrorCode::malformed, {"a.exr", "255"}, [&] { read_image(folder / "a.exr"); });
}

TEST(ExrReader, EveryCutIsTruncated) {
  const TemporaryFolder folder;
  Image image(24, 20);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Vec3f(static_cast<float>(i * i % 101));
  write_exr(image, folder / "whole.exr");
  std::ifstream file(folder / "whole.exr", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t size = 8; size < whole.size(); size += 1 + size / 50) {
    write_bytes(folder / "cut.exr", whole.substr(0, size));
    expect_error(ErrorCode::truncated, {"cut.exr"}, [&] { read_image(folder / "cut.exr"); });
  }
}

/// Reads a damaged file, which must either succeed or throw Error with a sentence of one line that names the file.
void read_or_refuse(const std::filesystem::path& path) {
  const std::string sentence = one_sentence(path);
  if (sentence.empty()) return;
  EXPECT_NE(sentence.find(path.filename().string()), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  EXPECT_LT(sentence.size(), 400u) << sentence;
}

TEST(ExrReader, DamagedBytesNeverDoMoreThanThrow) {
  const TemporaryFolder folder;
  Image image(40, 36);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Vec3f(static_cast<float>(i % 37), 1, static_cast<float>(i / 37));
  write_exr(image, folder / "whole.exr", {{"note", std::string("text")}});
  std::ifstream file(folder / "whole.exr", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  const std::string plain = uncompressed_exr(ExrHeader(), numbered);
  std::mt19937 generator(3);
  for (int round = 0; round < 600; ++round) {
    std::string bytes = round % 2 == 0 ? whole : plain;
    // most of the rounds in the header and the offsets, where a byte decides most
    const std::size_t reach = round % 3 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 420);
    for (unsigned change = 0; change <= generator() % 4; ++change) bytes[8 + generator() % (reach - 8)] = static_cast<char>(generator());
    write_bytes(folder / "damaged.exr", bytes);
    read_or_refuse(folder / "damaged.exr");
  }
}

TEST(ExrReader, RandomBytesBehindTheMagicNumberAreRefused) {
  const TemporaryFolder folder;
  std::mt19937 generator(5);
  for (int round = 0; round < 100; ++round) {
    ExrBytes bytes;
    bytes.i32(20000630).i32(2);
    for (unsigned i = 0; i < generator() % 500; ++i) bytes.u8(generator() % 256);
    write_bytes(folder / "random.exr", bytes.bytes());
    EXPECT_NE(one_sentence(folder / "random.exr"), "");
    read_or_refuse(folder / "random.exr");
  }
}

}  // namespace
}  // namespace brdf::render

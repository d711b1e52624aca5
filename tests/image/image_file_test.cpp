// SPDX-License-Identifier: Apache-2.0
// Pictures survive the way to a file and back.
#include "image/image_file.h"
#include "image/srgb.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <fstream>

namespace brdf::render {
namespace {

using test::expect_error;
using test::TemporaryFolder;

Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = {0.37F * static_cast<float>(x), 1000.0F * static_cast<float>(y) - 7.0F, 1e-3F * static_cast<float>(x * y)};
  }
  return image;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ExrFile, FloatsReturnBitForBit) {
  const TemporaryFolder folder;
  const Image image = gradient(37, 21);
  write_exr(image, folder / "a.exr");
  const Image back = read_image(folder / "a.exr");
  ASSERT_EQ(back.width, 37);
  ASSERT_EQ(back.height, 21);
  EXPECT_EQ(back.pixels, image.pixels);
}

TEST(ExrFile, HalvesReturnWithinTheirPrecisionAndAreClippedBeyond) {
  const TemporaryFolder folder;
  Image image = gradient(9, 8);
  image.at(0, 0) = {1e9F, -1e9F, 65504};
  write_exr(image, folder / "a.exr", {}, ExrPixels::half);
  const Image back = read_image(folder / "a.exr");
  EXPECT_EQ(back.at(0, 0), Vec3f(65504, -65504, 65504));
  for (std::size_t i = 1; i < image.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.pixels[i][c], image.pixels[i][c], std::abs(image.pixels[i][c]) / 2048 + 1e-7F);
  }
}

TEST(ExrFile, MetadataReturn) {
  const TemporaryFolder folder;
  const Metadata written{{"scene", std::string("ball.json")}, {"samplesPerPixel", 64.0F}};
  write_exr(gradient(2, 2), folder / "a.exr", written);
  Metadata read;
  read_image(folder / "a.exr", {}, &read);
  EXPECT_EQ(std::get<std::string>(read.at("scene")), "ball.json");
  EXPECT_EQ(std::get<float>(read.at("samplesPerPixel")), 64.0F);
}

TEST(ExrFile, NamesWithAMeaningOfTheirOwnAreRefused) {
  const TemporaryFolder folder;
  for (const char* name : {"", "channels", "dataWindow", "compression", "chromaticities", "a name of more than 31 characters"}) {
    expect_error(ErrorCode::invalid_argument, {"a.exr", "attribute"},
                 [&] { write_exr(gradient(2, 2), folder / "a.exr", {{name, 1.0F}}); });
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

TEST(ExrFile, BytesDependOnTheArgumentsAlone) {
  const TemporaryFolder folder;
  write_exr(gradient(33, 40), folder / "a.exr", {{"note", std::string("x")}});
  write_exr(gradient(33, 40), folder / "b.exr", {{"note", std::string("x")}});
  EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
}

TEST(ExrFile, AnExistingFileIsKeptUnlessItMayBeReplaced) {
  const TemporaryFolder folder;
  write_exr(gradient(2, 2), folder / "a.exr");
  const std::string before = bytes_of(folder / "a.exr");
  expect_error(ErrorCode::io, {"a.exr", "exists"},
               [&] { write_exr(gradient(3, 3), folder / "a.exr", {}, ExrPixels::half, false); });
  EXPECT_EQ(bytes_of(folder / "a.exr"), before);
  write_exr(gradient(3, 3), folder / "a.exr");
  EXPECT_EQ(read_image(folder / "a.exr").width, 3);
}

TEST(ImageFile, EmptyPicturesAreRefused) {
  const TemporaryFolder folder;
  expect_error(ErrorCode::invalid_argument, {"a.exr", "without pixels"}, [&] { write_exr(Image(), folder / "a.exr"); });
  expect_error(ErrorCode::invalid_argument, {"a.png", "without pixels"}, [&] { write_png(Image(), folder / "a.png", 0); });
  expect_error(ErrorCode::invalid_argument, {"a.png", "exposure"}, [&] { write_png(gradient(2, 2), folder / "a.png", NAN); });
}

TEST(Srgb, TransferFunctionAtItsKnownPoints) {
  EXPECT_EQ(srgb_code(0), 0);
  EXPECT_EQ(srgb_code(1), 255);
  EXPECT_EQ(srgb_code(7), 255);
  EXPECT_EQ(srgb_code(-1), 0);
  EXPECT_EQ(srgb_code(std::nan("")), 0);
  EXPECT_EQ(srgb_code(0.5), 188);
  EXPECT_EQ(srgb_code(0.18), 118);
  for (int code = 0; code < 256; ++code) EXPECT_EQ(srgb_code(srgb_decode(code / 255.0)), code);
}

TEST(Developed, ExposureIsInStops) {
  Image image(2, 1);
  image.at(0, 0) = Vec3f(0.25F);
  image.at(1, 0) = {0.125F, 4, -1};
  const Raster raster = developed(image, 1);
  EXPECT_EQ(raster.at(0, 0), (Rgb8{188, 188, 188}));
  EXPECT_EQ(raster.at(1, 0), (Rgb8{137, 255, 0}));
}

}  // namespace
}  // namespace brdf::render

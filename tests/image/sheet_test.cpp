// SPDX-License-Identifier: Apache-2.0
// Comparisons as pictures: colours, letters, the sheet.
#include "image/bitmap_font.h"
#include "image/colour_maps.h"
#include "image/comparison_sheet.h"
#include "image/figure_text.h"
#include "image/metric_pictures.h"
#include "image/srgb.h"
#include "support/expect_error.h"

#include <algorithm>
#include <set>

namespace brdf::render {
namespace {

using test::expect_error;

double lightness(Rgb8 colour) {
  const auto linear = [&](std::size_t c) { return srgb_decode(colour[c] / 255.0); };
  const double y = 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

TEST(ColourMaps, SequentialGrowsLighterFromBlackToNearlyWhite) {
  EXPECT_EQ(sequential_colour(0), (Rgb8{0, 0, 0}));
  EXPECT_GT(lightness(sequential_colour(1)), 95);
  for (int i = 1; i <= 256; ++i) EXPECT_GE(lightness(sequential_colour(i / 256.0)), lightness(sequential_colour((i - 1) / 256.0)));
  EXPECT_EQ(sequential_colour(-3), sequential_colour(0));
  EXPECT_EQ(sequential_colour(7), sequential_colour(1));
  EXPECT_EQ(sequential_colour(std::nan("")), sequential_colour(0));
}

TEST(ColourMaps, DivergingTellsTheSignAndTheSize) {
  const Rgb8 zero = diverging_colour(0);
  EXPECT_EQ(zero[0], zero[1]);
  EXPECT_EQ(zero[1], zero[2]);
  for (int i = 1; i <= 100; ++i) {
    const Rgb8 plus = diverging_colour(i / 100.0), minus = diverging_colour(-i / 100.0);
    EXPECT_GT(plus[0], plus[2]);
    EXPECT_EQ(plus, (Rgb8{minus[2], minus[1], minus[0]}));
    EXPECT_LE(lightness(plus), lightness(diverging_colour((i - 1) / 100.0)));
    EXPECT_LE(lightness(minus), lightness(diverging_colour(-(i - 1) / 100.0)));
  }
  EXPECT_EQ(diverging_colour(9), diverging_colour(1));
  EXPECT_EQ(diverging_colour(-9), diverging_colour(-1));
}

TEST(BitmapFont, EveryCharacterLooksDifferent) {
  std::set<std::vector<Rgb8>> seen;
  for (char character = ' '; character <= '~'; ++character) {
    Raster raster(glyph_advance, line_advance);
    draw_text(raster, 0, 0, std::string(1, character), 1, {255, 255, 255});
    EXPECT_TRUE(seen.insert(raster.pixels).second) << character;
  }
  EXPECT_EQ(seen.size(), 95u);
}

TEST(BitmapFont, ClipsAtEveryBorder) {
  Raster raster(20, 12);
  draw_text(raster, -7, -5, "clipped on all sides", 3, {255, 0, 0});
  draw_text(raster, 15, 9, "W", 2, {255, 0, 0});
  draw_text(raster, 500, 500, "W", 2, {255, 0, 0});
  EXPECT_EQ(raster.pixels.size(), 240u);
  EXPECT_GT(std::count(raster.pixels.begin(), raster.pixels.end(), Rgb8{255, 0, 0}), 0);
}

/// Whether a column or row of the sheet holds the colour.
bool has_colour(const Raster& raster, Rgb8 colour, int left, int right) {
  for (int y = 0; y < raster.height; ++y) {
    for (int x = left; x < right; ++x) {
      if (raster.at(x, y) == colour) return true;
    }
  }
  return false;
}

TEST(ComparisonSheet, ShowsFourPanelsOfWhichTheThirdTellsTheSign) {
  Image grey(300, 40);
  for (Vec3f& pixel : grey.pixels) pixel = Vec3f(0.5F);
  Image darker = grey, brighter = grey;
  for (Vec3f& pixel : darker.pixels) pixel *= 0.98F;
  for (Vec3f& pixel : brighter.pixels) pixel *= 1.02F;
  const Rgb8 red = diverging_colour(1), blue = diverging_colour(-1);
  for (const bool is_darker : {true, false}) {
    const Image& candidate = is_darker ? darker : brighter;
    const Raster sheet = comparison_sheet(grey, candidate, compare_images(grey, candidate, std::nullopt), {}, 0);
    EXPECT_GT(sheet.width, 4 * 300);
    const auto count = [&](Rgb8 colour) { return std::count(sheet.pixels.begin(), sheet.pixels.end(), colour); };
    EXPECT_GT(count(is_darker ? blue : red), 40 * 300);   // the panel
    EXPECT_LT(count(is_darker ? red : blue), 40 * 30);    // the end of its colour bar
    EXPECT_TRUE(has_colour(sheet, {188, 188, 188}, 0, 300));
  }
}

TEST(ComparisonSheet, SmallPicturesAreEnlarged) {
  const Image small(16, 16);
  const Raster sheet = comparison_sheet(small, small, compare_images(small, small, std::nullopt), {{"a"}, {"b"}}, 0);
  EXPECT_GE(sheet.width, 4 * 240);
  expect_error(ErrorCode::invalid_argument, {"16 x 16"},
               [&] { comparison_sheet(Image(20, 20), Image(20, 20), compare_images(small, small, std::nullopt), {}, 0); });
}

TEST(FigureText, TellsTheFloorBesideTheFigure) {
  ComparisonResult result;
  result.flip = {0.0123456, 0.002};
  result.psnr = {41.239, std::nullopt};
  const std::vector<FigureRow> rows = figure_rows(result);
  EXPECT_EQ(figure_line(rows[0]), "PSNR (dB) 41.24");
  EXPECT_EQ(figure_line(rows[2]), "FLIP 0.01235, noise 0.00200");
  EXPECT_EQ(figure_text(rows[0], std::nullopt), "-");
}

}  // namespace
}  // namespace brdf::render

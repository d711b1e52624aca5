// SPDX-License-Identifier: Apache-2.0
#include "image/bitmap_font.h"
#include "image/colour_maps.h"
#include "image/comparison_sheet.h"
#include "image/figure_text.h"
#include "image/image_file.h"
#include "image/luminance.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace brdf::render {
namespace {

constexpr Rgb8 paper{255, 255, 255}, ink{30, 30, 36}, faint{105, 105, 115};
constexpr int least_panel = 240, pixels_per_dot = 320;

struct Panel {
  std::string title;
  Raster picture;
  std::vector<std::string> lines;
  std::function<Rgb8(double)> bar;                 ///< colour of a place from 0 to 1, if there is a colour bar
  std::array<std::string, 3> ticks{};              ///< at its left end, middle and right end
};

Raster enlarged(const Raster& raster, int factor) {
  Raster result(raster.width * factor, raster.height * factor);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) result.at(x, y) = raster.at(x / factor, y / factor);
  }
  return result;
}

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"  // every caller passes a literal
  std::snprintf(text.data(), text.size(), format, value);
#pragma GCC diagnostic pop
  return text.data();
}

/// The next of 1, 2, 5 times a power of ten.
double rounded_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  }
  return 10 * decade;
}

Plane exposed_luminance(const Image& difference, float stops) {
  Plane plane(difference.width, difference.height);
  const float factor = std::exp2(stops);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = factor * luminance(difference.pixels[i]);
  return plane;
}

/// A range that a few fireflies do not stretch; 1 where there is no difference at all.
double range_of(const Plane& plane) {
  std::vector<float> sizes;
  sizes.reserve(plane.values.size());
  for (const float value : plane.values) sizes.push_back(std::abs(value));
  const auto percentile = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 99 / 100);
  std::nth_element(sizes.begin(), percentile, sizes.end());
  const float common = *percentile > 0 ? *percentile : *std::max_element(percentile, sizes.end());
  return common > 0 ? rounded_up(static_cast<double>(common)) : 1;
}

Raster coloured(const Plane& plane, const std::function<Rgb8(double)>& colour) {
  Raster raster(plane.width, plane.height);
  for (std::size_t i = 0; i < raster.pixels.size(); ++i) raster.pixels[i] = colour(static_cast<double>(plane.values[i]));
  return raster;
}

Panel difference_panel(const ComparisonResult& result, float stops) {
  const Plane plane = exposed_luminance(result.difference, stops);
  const double range = range_of(plane);
  Panel panel{"candidate - reference", coloured(plane, [&](double v) { return diverging_colour(v / range); }), {}, {}, {}};
  panel.bar = [](double place) { return diverging_colour(2 * place - 1); };
  panel.ticks = {number("%.3g", -range), "0 (luminance, white is 1)", number("+%.3g", range)};
  std::string mean = "mean " + number("%+.3g", result.mean_signed);
  if (result.mean_signed_deviation) mean += ", noise " + number("%.1g", *result.mean_signed_deviation);
  panel.lines.push_back(std::move(mean));
  return panel;
}

Panel flip_panel(const ComparisonResult& result) {
  Panel panel{"FLIP", coloured(result.flip_map, sequential_colour), {}, sequential_colour, {"0", "", "1"}};
  return panel;
}

void fill(Raster& sheet, int left, int top, int width, int height, const std::function<Rgb8(int)>& colour_of_column) {
  for (int x = 0; x < width; ++x) {
    const Rgb8 colour = colour_of_column(x);
    for (int y = 0; y < height; ++y) sheet.at(left + x, top + y) = colour;
  }
}

std::string fitted(std::string text, int width, int scale) {
  if (text_width(text, scale) <= width) return text;
  while (!text.empty() && text_width(text + "..", scale) > width) text.pop_back();
  return text + "..";
}

/// Places of a panel's parts, in pixels from its top.
struct Measures {
  int scale, margin, title, picture_height, bar_height, bar, height;
};

void draw_bar(Raster& sheet, const Panel& panel, int left, int top, const Measures& m) {
  const int width = panel.picture.width;
  fill(sheet, left, top, width, m.bar_height, [&](int x) { return panel.bar((x + 0.5) / width); });
  const int below = top + m.bar_height + 3 * m.scale;
  draw_text(sheet, left, below, panel.ticks[0], m.scale, faint);
  draw_text(sheet, left + width - text_width(panel.ticks[2], m.scale), below, panel.ticks[2], m.scale, faint);
  const std::string& middle = panel.ticks[1];
  draw_text(sheet, left + (width - text_width(middle, m.scale)) / 2, below, middle, m.scale, faint);
}

void draw_panel(Raster& sheet, const Panel& panel, int left, const Measures& m) {
  const int width = panel.picture.width;
  draw_text(sheet, left, m.margin, fitted(panel.title, width, m.scale), m.scale, ink);
  const int picture_top = m.margin + m.title;
  for (int y = 0; y < panel.picture.height; ++y) {
    for (int x = 0; x < width; ++x) sheet.at(left + x, picture_top + y) = panel.picture.at(x, y);
  }
  int y = picture_top + m.picture_height + m.bar;
  if (panel.bar) draw_bar(sheet, panel, left, picture_top + m.picture_height + 4 * m.scale, m);
  if (!panel.bar) y = picture_top + m.picture_height + 5 * m.scale;
  for (const std::string& line : panel.lines) {
    draw_text(sheet, left, y, fitted(line, width, m.scale), m.scale, ink);
    y += line_advance * m.scale;
  }
}

}  // namespace

Raster comparison_sheet(const Image& reference, const Image& candidate, const ComparisonResult& result,
                        const SheetLabels& labels, float exposure_stops) {
  check_same_size(reference, candidate);
  check_same_size(reference, result.difference);
  std::array<Panel, 4> panels{
      Panel{"reference", developed(reference, exposure_stops), labels.reference, {}, {}},
      Panel{"candidate", developed(candidate, exposure_stops), labels.candidate, {}, {}},
      difference_panel(result, exposure_stops),
      flip_panel(result),
  };
  // What the eye judges stands under the FLIP map, what is counted in radiance under the difference.
  const std::vector<FigureRow> rows = figure_rows(result);
  for (std::size_t i = 0; i < rows.size(); ++i) panels[i < 4 ? 3 : 2].lines.push_back(figure_line(rows[i]));

  const int factor = std::max(1, (least_panel + reference.width - 1) / reference.width);
  std::size_t most_lines = 0, most_plain = 0;
  for (Panel& panel : panels) {
    panel.picture = enlarged(panel.picture, factor);
    (panel.bar ? most_lines : most_plain) = std::max(panel.bar ? most_lines : most_plain, panel.lines.size());
  }
  const int width = panels[0].picture.width;
  Measures m{};
  m.scale = std::max(1, (width + pixels_per_dot / 2) / pixels_per_dot);
  m.margin = 6 * m.scale;
  m.title = line_advance * m.scale;
  m.picture_height = panels[0].picture.height;
  m.bar_height = 6 * m.scale;
  m.bar = 4 * m.scale + m.bar_height + 3 * m.scale + line_advance * m.scale + 3 * m.scale;
  const int barred = m.bar + static_cast<int>(most_lines) * line_advance * m.scale;
  const int plain = 5 * m.scale + static_cast<int>(most_plain) * line_advance * m.scale;
  m.height = 2 * m.margin + m.title + m.picture_height + std::max(barred, plain);

  Raster sheet(4 * width + 5 * m.margin, m.height, paper);
  int left = m.margin;
  for (const Panel& panel : panels) {
    draw_panel(sheet, panel, left, m);
    left += width + m.margin;
  }
  return sheet;
}

}  // namespace brdf::render

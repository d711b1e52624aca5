// SPDX-License-Identifier: Apache-2.0
#include "ingest/bilinear_density.h"

#include "ingest/vertex_cell.h"

#include <algorithm>

namespace brdf::ingest {
namespace {

double lerp(double a, double b, double t) noexcept { return (1 - t) * a + t * b; }

/// Integral over [0, t] of the line from a at 0 to b at 1.
double line_integral(double a, double b, double t) noexcept { return t * (a + t * (b - a) / 2); }

}  // namespace

BilinearDensity::BilinearDensity(const std::vector<float>& tables, std::size_t height, std::size_t width)
    : height_(height), width_(width), samples_(tables.size()), rows_(tables.size() / width) {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    double sum = 0;
    for (std::size_t x = 0; x < width; ++x) {
      const double here = tables[r * width + x];
      if (x > 0) sum += (double{tables[r * width + x - 1]} + here) / 2;
      samples_[r * width + x] = {here, sum};
    }
    rows_[r].total = sum;
  }
  for (std::size_t first = 0; first < rows_.size(); first += height) {
    double sum = 0;
    for (std::size_t y = 0; y < height; ++y) {
      if (y > 0) sum += (rows_[first + y - 1].total + rows_[first + y].total) / 2;
      rows_[first + y].before = sum;
    }
    if (!(sum > 0)) continue;
    for (std::size_t y = 0; y < height; ++y) {
      rows_[first + y].total /= sum;
      rows_[first + y].before /= sum;
    }
    for (std::size_t k = first * width; k < (first + height) * width; ++k) {
      samples_[k].density /= sum;
      samples_[k].before /= sum;
    }
  }
}

SquarePoint BilinearDensity::to_uniform(SquarePoint p, const SliceBlend& blend) const noexcept {
  const VertexCell x = vertex_cell(p.u * static_cast<double>(width_ - 1), width_);
  const VertexCell y = vertex_cell(p.v * static_cast<double>(height_ - 1), height_);
  double left = 0, right = 0, along_row = 0;  // of the interpolated row
  double row_below = 0, row_above = 0, rows_before = 0;
  for (const auto& [slice, weight] : blend) {
    const std::size_t row = slice * height_ + y.left;
    const Sample* const lower = samples_.data() + row * width_ + x.left;
    const Sample* const upper = lower + width_;
    left += weight * lerp(lower[0].density, upper[0].density, y.fraction);
    right += weight * lerp(lower[1].density, upper[1].density, y.fraction);
    along_row += weight * lerp(lower[0].before, upper[0].before, y.fraction);
    row_below += weight * rows_[row].total;
    row_above += weight * rows_[row + 1].total;
    rows_before += weight * rows_[row].before;
  }
  const double row_total = lerp(row_below, row_above, y.fraction);
  const double u = row_total > 0 ? (along_row + line_integral(left, right, x.fraction)) / row_total : 0.0;
  const double v = rows_before + line_integral(row_below, row_above, y.fraction);
  return {std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0)};
}

}  // namespace brdf::ingest

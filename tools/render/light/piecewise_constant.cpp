// SPDX-License-Identifier: Apache-2.0
#include "light/piecewise_constant.h"

#include <algorithm>
#include <numeric>

namespace brdf::render {
namespace {

constexpr float below_one = 0x1.fffffep-1F;

std::size_t cell_of(float x, std::size_t size) noexcept {
  const float scaled = x * static_cast<float>(size);
  return scaled > 0 ? std::min(static_cast<std::size_t>(scaled), size - 1) : 0;
}

}  // namespace

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const double> weights) {
  const std::size_t n = weights.size();
  sum_ = std::accumulate(weights.begin(), weights.end(), 0.0);
  cdf_.resize(n + 1);
  density_.resize(n);
  double below = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double share = sum_ > 0 ? weights[i] / sum_ : 1.0 / static_cast<double>(n);
    cdf_[i] = static_cast<float>(below);
    density_[i] = static_cast<float>(share * static_cast<double>(n));
    below += share;
  }
  cdf_[n] = 1;
}

PiecewiseConstant1D::Draw PiecewiseConstant1D::sample(float u) const noexcept {
  const std::size_t n = density_.size();
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  Draw draw;
  draw.cell = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cdf_.begin() - 1, 0)), n - 1);
  const float low = cdf_[draw.cell], width = cdf_[draw.cell + 1] - low;
  const float within = width > 0 ? std::clamp((u - low) / width, 0.0f, below_one) : 0.5f;
  draw.x = std::min((static_cast<float>(draw.cell) + within) / static_cast<float>(n), below_one);
  draw.density = density_[draw.cell];
  return draw;
}

PiecewiseConstant2D::PiecewiseConstant2D(std::span<const double> weights, std::size_t width, std::size_t height) {
  std::vector<double> sums;
  sums.reserve(height);
  columns_.reserve(height);
  for (std::size_t y = 0; y < height; ++y) {
    columns_.emplace_back(weights.subspan(y * width, width));
    sums.push_back(columns_.back().sum());
  }
  rows_ = PiecewiseConstant1D(sums);
}

PiecewiseConstant2D::Draw PiecewiseConstant2D::sample(const glm::vec2& u) const noexcept {
  const PiecewiseConstant1D::Draw row = rows_.sample(u.y);
  const PiecewiseConstant1D::Draw column = columns_[row.cell].sample(u.x);
  return {{column.x, row.x}, row.density * column.density};
}

float PiecewiseConstant2D::density(const glm::vec2& at) const noexcept {
  const std::size_t row = cell_of(at.y, rows_.size());
  return rows_.density(row) * columns_[row].density(cell_of(at.x, columns_[row].size()));
}

}  // namespace brdf::render

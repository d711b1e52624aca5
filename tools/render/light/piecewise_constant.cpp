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
  cells_.resize(n);
  std::vector<double> rest(n);  // of each cell, in units of the mean
  std::vector<std::uint32_t> poor, rich;
  for (std::size_t i = 0; i < n; ++i) {
    rest[i] = sum_ > 0 ? weights[i] / sum_ * static_cast<double>(n) : 1.0;
    cells_[i].density = cells_[i].other_density = static_cast<float>(rest[i]);
    cells_[i].other = static_cast<std::uint32_t>(i);
    (rest[i] < 1 ? poor : rich).push_back(static_cast<std::uint32_t>(i));
  }
  while (!poor.empty() && !rich.empty()) {
    const std::uint32_t small = poor.back(), large = rich.back();
    poor.pop_back();
    cells_[small].own = static_cast<float>(rest[small]);
    cells_[small].other = large;
    cells_[small].other_density = cells_[large].density;
    rest[large] -= 1 - rest[small];
    if (rest[large] >= 1) continue;
    rich.pop_back();
    poor.push_back(large);
  }
}

PiecewiseConstant1D::Draw PiecewiseConstant1D::sample(float u) const noexcept {
  const float n = static_cast<float>(cells_.size()), scaled = u * n;
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), cells_.size() - 1);
  const Cell& cell = cells_[i];
  const float within = scaled - static_cast<float>(i);
  const bool stays = within < cell.own;
  // what is left of u within the part that was met is uniform again
  const float fresh = stays ? within / cell.own : (within - cell.own) / (1 - cell.own);
  Draw draw;
  draw.cell = stays ? i : cell.other;
  draw.density = stays ? cell.density : cell.other_density;
  draw.x = std::min((static_cast<float>(draw.cell) + std::clamp(fresh, 0.0f, below_one)) / n, below_one);
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
  density_.reserve(width * height);
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) density_.push_back(rows_.density(y) * columns_[y].density(x));
}

PiecewiseConstant2D::Draw PiecewiseConstant2D::sample(const glm::vec2& u) const noexcept {
  const PiecewiseConstant1D::Draw row = rows_.sample(u.y);
  const PiecewiseConstant1D::Draw column = columns_[row.cell].sample(u.x);
  return {{column.x, row.x}, row.density * column.density};
}

float PiecewiseConstant2D::density(const glm::vec2& at) const noexcept {
  const std::size_t width = columns_.front().size();
  return density_[cell_of(at.y, rows_.size()) * width + cell_of(at.x, width)];
}

}  // namespace brdf::render

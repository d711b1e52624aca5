// SPDX-License-Identifier: Apache-2.0
#include "light/piecewise_constant.h"

#include <algorithm>
#include <numeric>

namespace brdf::render {
namespace {

constexpr float below_one = 0x1.fffffep-1F;

/// Fills in `cells` for weights that are given in units of their mean.
void make_alias_table(std::vector<double> rest, std::span<AliasCell> cells) {
  std::vector<std::uint32_t> poor, rich;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    cells[i] = {1, i};
    (rest[i] < 1 ? poor : rich).push_back(i);
  }
  while (!poor.empty() && !rich.empty()) {
    const std::uint32_t small = poor.back(), large = rich.back();
    poor.pop_back();
    cells[small] = {static_cast<float>(rest[small]), large};
    rest[large] -= 1 - rest[small];
    if (rest[large] >= 1) continue;
    rich.pop_back();
    poor.push_back(large);
  }
}

/// Weights in units of their mean; all 1 where that is 0.
std::vector<double> over_mean(std::span<const double> weights, double sum) {
  std::vector<double> result(weights.size(), 1.0);
  const double mean = sum / static_cast<double>(weights.size());
  if (mean > 0) std::transform(weights.begin(), weights.end(), result.begin(), [mean](double w) { return w / mean; });
  return result;
}

double sum_of(std::span<const double> weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

PiecewiseConstant1D::Draw draw(std::span<const AliasCell> cells, float u) noexcept {
  const float n = static_cast<float>(cells.size()), scaled = u * n;
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), cells.size() - 1);
  const AliasCell cell = cells[i];
  const float within = scaled - static_cast<float>(i);
  // 0 or 1, and sums of products instead of a branch that would be wrong as often as not
  const float leaves = static_cast<float>(within >= cell.own), begin = leaves * cell.own;
  // what is left of u within the part that was met is uniform again
  const float fresh = (within - begin) / (cell.own - begin + leaves * (1 - cell.own));
  const std::size_t met = within >= cell.own ? cell.other : i;
  return {std::min((static_cast<float>(met) + std::clamp(fresh, 0.0f, below_one)) / n, below_one), met};
}

}  // namespace

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const double> weights) : cells_(weights.size()), sum_(sum_of(weights)) {
  std::vector<double> shares = over_mean(weights, sum_);
  density_.assign(shares.begin(), shares.end());
  make_alias_table(std::move(shares), cells_);
}

PiecewiseConstant1D::Draw PiecewiseConstant1D::sample(float u) const noexcept { return draw(cells_, u); }

PiecewiseConstant2D::PiecewiseConstant2D(std::span<const double> weights, std::size_t width, std::size_t height)
    : columns_(width * height), width_(width) {
  std::vector<double> sums;
  sums.reserve(height);
  for (std::size_t y = 0; y < height; ++y) {
    const std::span<const double> row = weights.subspan(y * width, width);
    sums.push_back(sum_of(row));
    make_alias_table(over_mean(row, sums.back()), std::span(columns_).subspan(y * width, width));
  }
  rows_ = PiecewiseConstant1D(sums);
}

float PiecewiseConstant2D::sample_column(std::size_t row, float u) const noexcept { return draw({&columns_[row * width_], width_}, u).x; }

void PiecewiseConstant2D::prefetch(std::size_t row, float u) const noexcept {
  const auto column = std::min(static_cast<std::size_t>(u * static_cast<float>(width_)), width_ - 1);
  __builtin_prefetch(&columns_[row * width_ + column]);
}

}  // namespace brdf::render

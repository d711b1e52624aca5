// SPDX-License-Identifier: Apache-2.0
// Densities on [0, 1) and on its square that are constant in cells of equal size, sampled by the alias method (Walker 1977;
// tables by Vose 1991): one place in memory is read for a draw, whatever the number of cells.
#pragma once

#include "memory/large_pages.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace brdf::render {

/// A draw takes this cell or, beyond `own` of its width, the other one.
struct AliasCell {
  float own = 1;
  std::uint32_t other = 0;
};

/// One row of cells. Weights that are all zero give a uniform density.
class PiecewiseConstant1D {
 public:
  PiecewiseConstant1D() = default;
  explicit PiecewiseConstant1D(std::span<const double> weights);

  struct Draw {
    float x = 0;             ///< in [0, 1)
    std::size_t cell = 0;
  };
  Draw sample(float u) const noexcept;
  /// Per unit of x.
  float density(std::size_t cell) const noexcept { return density_[cell]; }
  /// Probability of a cell.
  float probability(std::size_t cell) const noexcept { return density_[cell] / static_cast<float>(cells_.size()); }
  std::size_t size() const noexcept { return cells_.size(); }
  double sum() const noexcept { return sum_; }  ///< of the weights

 private:
  std::vector<AliasCell> cells_;
  std::vector<float> density_;
  double sum_ = 0;
};

/// width x height cells, row by row. The density of a cell, per unit of area, is its weight over the mean of all (1 where that is 0).
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  PiecewiseConstant2D(std::span<const double> weights, std::size_t width, std::size_t height);

  /// x runs along rows.
  /// A row, and a place in it from 0 to 1.
  PiecewiseConstant1D::Draw sample_row(float u) const noexcept { return rows_.sample(u); }
  float sample_column(std::size_t row, float u) const noexcept;
  /// Brings to the caches what `sample_column` of the same will read.
  void prefetch(std::size_t row, float u) const noexcept;
  double sum() const noexcept { return rows_.sum(); }

 private:
  PiecewiseConstant1D rows_;
  std::vector<AliasCell, LargePages<AliasCell>> columns_;  ///< of all rows
  std::size_t width_ = 0;
};

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Densities on [0, 1) and on its square that are constant in cells of equal size, sampled by the alias method (Walker 1977;
// tables by Vose 1991): one place in memory is read for a draw, whatever the number of cells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace brdf::render {

/// One row of cells. Weights that are all zero give a uniform density.
class PiecewiseConstant1D {
 public:
  PiecewiseConstant1D() = default;
  explicit PiecewiseConstant1D(std::span<const double> weights);

  struct Draw {
    float x = 0;             ///< in [0, 1)
    float density = 0;       ///< per unit of x
    std::size_t cell = 0;
  };
  Draw sample(float u) const noexcept;
  float density(std::size_t cell) const noexcept { return cells_[cell].density; }
  /// Probability of a cell.
  float probability(std::size_t cell) const noexcept { return cells_[cell].density / static_cast<float>(cells_.size()); }
  std::size_t size() const noexcept { return cells_.size(); }
  double sum() const noexcept { return sum_; }  ///< of the weights

 private:
  /// A draw takes this cell or, beyond `own` of its width, the other one.
  struct Cell {
    float own = 1, density = 0, other_density = 0;
    std::uint32_t other = 0;
  };
  std::vector<Cell> cells_;
  double sum_ = 0;
};

/// width x height cells, row by row.
class PiecewiseConstant2D {
 public:
  PiecewiseConstant2D() = default;
  PiecewiseConstant2D(std::span<const double> weights, std::size_t width, std::size_t height);

  struct Draw {
    glm::vec2 at{0, 0};  ///< x along rows
    float density = 0;   ///< per unit of area
  };
  Draw sample(const glm::vec2& u) const noexcept;
  float density(const glm::vec2& at) const noexcept;
  double sum() const noexcept { return rows_.sum(); }

 private:
  PiecewiseConstant1D rows_;
  std::vector<PiecewiseConstant1D> columns_;
  std::vector<float> density_;  ///< of every cell, together in memory
};

}  // namespace brdf::render

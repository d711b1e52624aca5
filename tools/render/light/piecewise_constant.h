// SPDX-License-Identifier: Apache-2.0
// Densities on [0, 1) and on its square that are constant in cells of equal size, sampled by inversion.
#pragma once

#include <cstddef>
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
  float density(std::size_t cell) const noexcept { return density_[cell]; }
  /// Probability of a cell.
  float probability(std::size_t cell) const noexcept { return density_[cell] / static_cast<float>(density_.size()); }
  std::size_t size() const noexcept { return density_.size(); }
  double sum() const noexcept { return sum_; }  ///< of the weights

 private:
  std::vector<float> cdf_, density_;
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
};

}  // namespace brdf::render

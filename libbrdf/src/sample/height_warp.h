// SPDX-License-Identifier: Apache-2.0
// A map of [0, 1] to itself that spreads out the heights where lobes are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace brdf::sample {

/// t = y (line + sum_j share_j / (y + width_j)): each term rises like the integral of a GGX lobe of width_j = alpha^2 / 2 at
/// normal incidence. The narrowest has the most; wider ones follow, up to the whole range, because at grazing views the
/// horizon takes the lobe apart and measured lobes have long tails; a line is for what is diffuse.
class HeightWarp {
 public:
  static constexpr std::size_t terms = 4;

  /// Of a line alone.
  HeightWarp() = default;

  /// For lobes from this roughness on.
  explicit HeightWarp(double alpha) noexcept {
    constexpr double narrowest_share = 0.28, line_share = 0.22, widest = 0.5;
    const double narrowest = 0.5 * alpha * alpha;
    if (!(narrowest < 0.9 * widest)) return;
    double sum = 0;
    for (std::size_t j = 0; j < terms; ++j) {
      const double k = narrowest * std::pow(widest / narrowest, static_cast<double>(j) / static_cast<double>(terms));
      const double share = (1 - narrowest_share - line_share) / static_cast<double>(terms) + (j == 0 ? narrowest_share : 0.0);
      width[j] = static_cast<float>(k);
      rise[j] = static_cast<float>(share * (1 + k));
      sum += static_cast<double>(rise[j]) / (1 + static_cast<double>(width[j]));
    }
    line = static_cast<float>(1 - sum);
    steps = alpha < 1e-3 ? 2 : 1;
  }

  template <class T>
  struct Image {
    T t, slope;  ///< the latter is dt / dy
  };

  template <class T>
  Image<T> operator()(T y) const noexcept {
    T sum = static_cast<T>(line), slope = static_cast<T>(line);
    for (std::size_t j = 0; j < terms; ++j) {
      const T inverse = 1 / (y + static_cast<T>(width[j])), term = static_cast<T>(rise[j]) * inverse;
      sum += term;
      slope += term * (static_cast<T>(width[j]) * inverse);
    }
    return {y * sum, slope};
  }

  /// The y of a t. The map is concave, so that Newton's steps from below stay below.
  double inverse(double t) const noexcept {
    double y = 0;
    for (int step = 0; step < 60; ++step) {
      const Image<double> at = (*this)(y);
      const double next = y + (t - at.t) / at.slope;
      if (!(next > y)) break;
      y = next;
    }
    return std::clamp(y, 0.0, 1.0);
  }

  alignas(16) std::array<float, terms> width{1, 1, 1, 1};
  alignas(16) std::array<float, terms> rise{};  ///< share_j
  float line = 1;
  /// Of Halley's, from a WarpCell's start, to leave less than 1e-6 of a cell.
  int steps = 1;
};

}  // namespace brdf::sample

// SPDX-License-Identifier: Apache-2.0
// Sobol points with a fixed digital shift: the same points on every machine and for any number of threads.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace brdf::metrics {

using SobolDirections = std::array<std::array<std::uint32_t, 32>, 4>;

constexpr SobolDirections make_sobol_directions() noexcept {
  // degree s, coefficients a and initial m of dimensions 2 to 4; dimension 1 is the radical inverse
  struct Row {
    std::uint32_t s, a;
    std::array<std::uint32_t, 3> m;
  };
  constexpr std::array<Row, 3> rows{{{1, 0, {1, 0, 0}}, {2, 1, {1, 3, 0}}, {3, 1, {1, 3, 1}}}};
  SobolDirections v{};
  for (std::uint32_t k = 0; k < 32; ++k) v[0][k] = std::uint32_t{1} << (31 - k);
  for (std::size_t d = 0; d < rows.size(); ++d) {
    const Row& row = rows[d];
    for (std::uint32_t k = 0; k < 32; ++k) {
      if (k < row.s) {
        v[d + 1][k] = row.m[k] << (31 - k);
        continue;
      }
      std::uint32_t value = v[d + 1][k - row.s] ^ (v[d + 1][k - row.s] >> row.s);
      for (std::uint32_t j = 1; j < row.s; ++j)
        if ((row.a >> (row.s - 1 - j)) & 1) value ^= v[d + 1][k - j];
      v[d + 1][k] = value;
    }
  }
  return v;
}

/// Sobol sequence in up to four dimensions, direction numbers of Joe and Kuo (2008). Each dimension is shifted by a
/// constant (exclusive or), which keeps every stratification and moves the first point off the origin.
class Sobol {
 public:
  explicit Sobol(std::uint64_t seed) noexcept {
    for (std::size_t d = 0; d < shift_.size(); ++d) shift_[d] = hash(seed + d);
  }

  /// Point `index` in [0, 1)^4, independent of the points asked for before.
  std::array<double, 4> operator()(std::uint32_t index) const noexcept {
    std::array<double, 4> point{};
    for (std::size_t d = 0; d < point.size(); ++d) {
      std::uint32_t bits = shift_[d];
      for (std::uint32_t rest = index; rest != 0; rest &= rest - 1)
        bits ^= directions[d][static_cast<std::size_t>(std::countr_zero(rest))];
      point[d] = (bits + 0.5) * 0x1p-32;
    }
    return point;
  }

 private:
  static constexpr std::uint32_t hash(std::uint64_t x) noexcept {  // splitmix64 (Steele et al. 2014)
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::uint32_t>((x ^ (x >> 31)) >> 32);
  }

  static constexpr SobolDirections directions = make_sobol_directions();
  std::array<std::uint32_t, 4> shift_{};
};

}  // namespace brdf::metrics

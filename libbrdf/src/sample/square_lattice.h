// SPDX-License-Identifier: Apache-2.0
// Evenly spread numbers for Material::sample.
#pragma once

#include <brdf/direction.h>

#include <cstddef>

namespace brdf::sample {

/// One point in each of `strata` x `strata` equal squares of (u.y, u.z). Its place in the square walks by golden steps along
/// the row and along the column, so that each number alone takes evenly spread values too: much of what is integrated
/// depends on one of them only. The choice of the component, u.x, walks along the diagonals.
inline Vec3f lattice_point(std::size_t row, std::size_t column, std::size_t strata) noexcept {
  const auto golden = [](std::size_t n) {
    const double turns = (static_cast<double>(n) + 0.5) * 0.61803398874989485;
    return static_cast<float>(turns - static_cast<double>(static_cast<int>(turns)));
  };
  const auto width = static_cast<float>(strata);
  return {golden(row + column), (static_cast<float>(row) + golden(column)) / width, (static_cast<float>(column) + golden(row)) / width};
}

}  // namespace brdf::sample

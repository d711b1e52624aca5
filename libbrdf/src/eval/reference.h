// SPDX-License-Identifier: Apache-2.0
// The definition of a material's value, in double: what every float path is tested against.
#pragma once

#include "residual/residual_grid.h"

#include <brdf/lobes.h>

#include <span>

namespace brdf::eval {

/// Coordinates of a pair in the unit cube of a residual grid.
struct GridCoordinates {
  double u_h, u_d, u_p;
};
GridCoordinates grid_coordinates(const residual::ResidualGrid& grid, const Vec3d& wi, const Vec3d& wo) noexcept;

/// Trilinear ratio of channel `c` at `u`. The grid must not be empty.
double ratio_at(const residual::ResidualGrid& grid, const GridCoordinates& u, int c) noexcept;

/// f_c = max(0, (lobes_c + epsilon) R_c - epsilon), or the lobes alone for an empty grid; 0 at or below the horizon.
void eval_reference(const LobeSet& lobes, const residual::ResidualGrid& grid, const Vec3d& wi, const Vec3d& wo,
                    std::span<double> f) noexcept;

}  // namespace brdf::eval

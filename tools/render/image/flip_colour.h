// SPDX-License-Identifier: Apache-2.0
// The colour spaces of FLIP (2020 paper, section 4.1), all relative to sRGB's own white.
#pragma once

#include <brdf/direction.h>

namespace brdf::render {

/// Linear BT.709 to the opponent space Y_y C_x C_z, linear in XYZ, in which the contrast sensitivity filters work.
Vec3d opponent_from_linear(const Vec3d& rgb) noexcept;
Vec3d linear_from_opponent(const Vec3d& yxz) noexcept;

/// Linear BT.709 to CIELAB with both colour axes scaled by the lightness (the Hunt effect): a 0.01 L.
Vec3d hunt_lab_from_linear(const Vec3d& rgb) noexcept;

/// HyAB distance (Abasi et al. 2020): city block in lightness, Euclidean in colour.
double hyab(const Vec3d& a, const Vec3d& b) noexcept;

}  // namespace brdf::render

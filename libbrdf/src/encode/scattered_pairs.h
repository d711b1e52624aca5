// SPDX-License-Identifier: Apache-2.0
// Pairs of directions that stand for all of them.
#pragma once

#include <brdf/direction.h>

#include <cmath>
#include <numbers>

namespace brdf::encode {

/// Calls `visit(wi, wo)` for pairs within 78 degrees of the normal, by the R3 sequence (Roberts 2018).
template <class Visit>
void for_scattered_pairs(int count, Visit&& visit) {
  for (int i = 0; i < count; ++i) {
    const auto turn = [i](double ratio) { return std::fmod(0.5 + ratio * i, 1.0); };
    const double ci = 0.2 + 0.8 * turn(0.8191725134), co = 0.2 + 0.8 * turn(0.6710436067), phi = 2 * std::numbers::pi * turn(0.5497004779);
    const double si = std::sqrt(1 - ci * ci), so = std::sqrt(1 - co * co);
    visit(Vec3d{si * std::cos(phi), si * std::sin(phi), ci}, Vec3d{so, 0, co});
  }
}

}  // namespace brdf::encode

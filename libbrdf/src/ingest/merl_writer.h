// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/measurement.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace brdf::ingest {

/// f(wi, wo) in 1/sr without cosine as red, green, blue; false where there is none. Only called above the horizon.
using RgbFunction = std::function<bool(const Vec3d& wi, const Vec3d& wo, std::span<double, 3> f)>;

/// Bytes of a MERL file that holds `table`: valid cells as they are, wherever they lie, the others as -1 in all
/// channels. Reading the bytes back gives exactly the same floats and mask. `table` must have three channels and bin
/// counts that the format knows (90 x 90 x 180 or 360), valid values must be finite and at least 0:
/// Error(invalid_argument) otherwise.
std::vector<std::byte> write_merl(const HalfDifferenceTable& table);

/// Bytes of a 90 x 90 x 180 MERL file (360 with `full_circle`) of `f` taken at the sample positions. Invalid (-1) are
/// cells with a direction at or below the horizon and those where `f` answers false, a negative or a non-finite number.
/// Half a circle cannot hold f(wi, wo) != f(wo, wi): it keeps phi_d in [0, pi) and readers get the rest by exchange.
std::vector<std::byte> write_merl(const RgbFunction& f, SamplePosition position = SamplePosition::edge,
                                  bool full_circle = false);

}  // namespace brdf::ingest

// SPDX-License-Identifier: Apache-2.0
// What a material must evaluate to, in long double: docs/format.md put down literally, with angles and inverse
// trigonometric functions, and nothing shared with the library but the parameters of lobes and the nodes of a grid.
//
// Directions are floats taken as exact numbers. Hardly any has exactly unit length; the formulas are applied to it as it is.
#pragma once

#include "residual/residual_grid.h"

#include <brdf/lobes.h>

#include <array>
#include <limits>
#include <vector>

namespace brdf::test {

static_assert(std::numeric_limits<long double>::digits >= 64, "the reference needs more digits than double has");

/// wi.x, wi.y, wi.z, wo.x, wo.y, wo.z
using PairNumbers = std::array<long double, 6>;

inline PairNumbers pair_numbers(const Vec3f& wi, const Vec3f& wo) { return {wi.x, wi.y, wi.z, wo.x, wo.y, wo.z}; }

/// A value, and the sum of the magnitudes of the terms that it is the difference of: what rounding errors are measured by.
struct ReferenceResult {
  long double value = 0, scale = 0;
};

/// Both directions brought to unit length.
PairNumbers normalised(PairNumbers p);

/// Channel c of the sum of the lobes.
long double reference_lobes(const LobeSet& lobes, const PairNumbers& p, std::size_t c);

/// Trilinear ratio of channel c.
long double reference_ratio(const residual::ResidualGrid& grid, const PairNumbers& p, std::size_t c);

/// f_c of lobes and grid (which may be empty), 0 at or below the horizon.
ReferenceResult reference_value(const LobeSet& lobes, const residual::ResidualGrid& grid, const PairNumbers& p, std::size_t c);

/// Backward error of `computed` in float ulps: an upper bound of the smallest k such that the reference gives `computed`,
/// up to `roundings` units of 2^-24 of its scale, for a pair whose components differ from those of `p` by at most k of
/// their own ulps. 0 where the value itself is that close. `most` is returned when no k below it was found.
///
/// The reference is continuous above the horizon, so it takes every value between two that it takes: it is enough to find
/// one perturbation that gives more and one that gives less.
double backward_error(const LobeSet& lobes, const residual::ResidualGrid& grid, const Vec3f& wi, const Vec3f& wo, std::size_t c,
                      float computed, double roundings, double most = 64);

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// Checks that every material's sampling must pass, at every evaluation level.
#pragma once

#include "support/direction_batch.h"

#include <brdf/material.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brdf::test {

/// Degrees from the normal, up to 89.9.
std::vector<Vec3f> sampling_views();

struct Draws {
  DirectionBatch wi;
  std::vector<float> pdf;
  std::vector<double> weight;  ///< mean of the channels
};

Draws draw(const Material& m, const Vec3f& wo, std::size_t n, std::uint32_t seed);

/// Expects that directions follow pdf (chi-squared over theta and phi), that pdf integrates to 1, that the mean weight is
/// the integral of f cos_i, and that nothing is rejected or below the horizon. `p_threshold` as sidak_threshold has it.
void expect_sampling(const Material& m, const Vec3f& wo, std::size_t samples, double p_threshold);

/// Of the weight, over its mean.
struct WeightSpread {
  double largest, deviation;
};

WeightSpread weight_spread(const Material& m, const Vec3f& wo, std::size_t samples = 50000);

}  // namespace brdf::test

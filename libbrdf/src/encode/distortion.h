// SPDX-License-Identifier: Apache-2.0
// How much an error of the log ratio matters at each cell, under the metrics that are reported.
#pragma once

#include "encode/bins.h"

#include <vector>

namespace brdf::encode {

/// Relative importance of the metrics in the encoder's quadratic error model.
struct MetricMix {
  double lights = 1, log = 1, energy = 2, environment = 1;
};

/// One weight per cell: the error model's diagonal part, sum of weight * (error of y)^2.
/// Directional lights on a sphere, any angle between light and viewer alike: display-referred (gamma 2.2, clipped at
/// white, exposed to half grey) squared error. Plus the log metric, scaled to the same sum. Plus the share of reflected
/// energy: it keeps peaks that a light clips and that few rows of an environment meet.
std::vector<double> cell_weights(const Bins& bins, double epsilon, const MetricMix& mix);

}  // namespace brdf::encode

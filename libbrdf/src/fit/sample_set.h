// SPDX-License-Identifier: Apache-2.0
// Measured pairs that carry the loss of a fit.
#pragma once

#include <brdf/direction.h>

#include <cstddef>
#include <vector>

namespace brdf::fit {

/// Sample s has f at values[s * channels + c] in 1/sr without cosine, never negative and finite, both directions above
/// the horizon, and a positive weight. Any prefix covers the hemispheres like the whole, only more thinly.
struct SampleSet {
  int channels = 0;
  std::vector<Vec3d> wi, wo;
  std::vector<double> values;
  std::vector<double> weight;
  std::size_t size() const noexcept { return weight.size(); }
};

}  // namespace brdf::fit

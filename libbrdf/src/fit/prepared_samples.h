// SPDX-License-Identifier: Apache-2.0
// Samples in the form that the solver reads: unit scale, few channels, logarithms and geometry worked out once.
#pragma once

#include "fit/sample_set.h"
#include "lobes/lobe_geometry.h"

#include <cstddef>
#include <vector>

namespace brdf::fit {

/// Shapes are fitted to at most this many channels; of more, the means of adjacent groups are taken.
inline constexpr int max_shape_channels = 4;

/// Offset of the loss log((f cos_i + offset) / (lobes cos_i + offset)), relative to the mean f: below it nobody looks.
inline constexpr double log_offset = 0.01;

struct PreparedSamples {
  int channels = 0;
  double scale = 0;                         ///< f in 1/sr = scale * value; 0 when every sample is 0
  std::vector<lobes::LobeGeometry> mirror;  ///< for ggx
  std::vector<lobes::LobeGeometry> retro;   ///< for retro_ggx
  std::vector<double> cos_i;
  std::vector<double> value;       ///< [sample][channel], f / scale
  std::vector<double> log_target;  ///< [sample][channel], log(value cos_i + log_offset)
  std::vector<double> weight;      ///< mean 1
  std::vector<double> root_weight;
  double independent = 0;  ///< number of samples worth counting in a criterion
  std::size_t size() const noexcept { return weight.size(); }
};

/// Throws nothing but bad_alloc. `set` holds at least one sample.
PreparedSamples prepare_samples(const SampleSet& set);

/// First and one-past-last channel of group `g` of `groups`.
struct ChannelGroup {
  int begin, end;
};
ChannelGroup channel_group(int channels, int groups, int g) noexcept;

}  // namespace brdf::fit

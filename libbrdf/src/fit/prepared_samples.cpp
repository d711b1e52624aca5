// SPDX-License-Identifier: Apache-2.0
#include "fit/prepared_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace brdf::fit {
namespace {

/// Neighbouring samples see the same misfit, so of n samples only a part counts as independent evidence.
constexpr double samples_per_independent = 4;

/// A value that the bulk of the samples gives and no single cell can move: the weighted mean, each value limited to
/// 1000 medians. The mean, because lobes that carry little energy should count for little; the limit, because one
/// broken cell must not decide what is dark.
double robust_scale(const std::vector<double>& mean_value, const std::vector<double>& weight) {
  std::vector<double> positive;
  positive.reserve(mean_value.size());
  for (const double v : mean_value)
    if (v > 0) positive.push_back(v);
  if (positive.empty()) return 0;
  const auto middle = positive.begin() + static_cast<std::ptrdiff_t>(positive.size() / 2);
  std::nth_element(positive.begin(), middle, positive.end());
  const double median = *middle;
  double sum = 0, total = 0;
  for (std::size_t s = 0; s < weight.size(); ++s) {
    sum += weight[s] * std::min(mean_value[s] / median, 1000.0);  // divided first: 1e30 squared must not overflow later
    total += weight[s];
  }
  return median * (sum / total);
}

}  // namespace

ChannelGroup channel_group(int channels, int groups, int g) noexcept {
  return {channels * g / groups, channels * (g + 1) / groups};
}

PreparedSamples prepare_samples(const SampleSet& set) {
  PreparedSamples p;
  p.channels = std::min(set.channels, max_shape_channels);
  const std::size_t n = set.size(), from = static_cast<std::size_t>(set.channels);
  const auto to = static_cast<std::size_t>(p.channels);

  const double mean_weight = std::accumulate(set.weight.begin(), set.weight.end(), 0.0) / static_cast<double>(n);
  double squares = 0;
  for (const double w : set.weight) {
    p.weight.push_back(w / mean_weight);
    p.root_weight.push_back(std::sqrt(p.weight.back()));
    squares += p.weight.back() * p.weight.back();
  }
  // Kish 1965: n unequal weights are worth (sum w)^2 / sum w^2 equal ones
  p.independent = std::max(static_cast<double>(n) * static_cast<double>(n) / squares / samples_per_independent, 2.0);

  std::vector<double> mean_value(n);
  for (std::size_t s = 0; s < n; ++s) {
    for (std::size_t c = 0; c < from; ++c) mean_value[s] += set.values[s * from + c] / static_cast<double>(from);
  }
  p.scale = robust_scale(mean_value, p.weight);
  if (!(p.scale > 0)) return p;

  p.mirror.reserve(n);
  p.retro.reserve(n);
  p.cos_i.reserve(n);
  p.value.reserve(n * to);
  p.log_target.reserve(n * to);
  for (std::size_t s = 0; s < n; ++s) {
    p.mirror.push_back(lobes::lobe_geometry(LobeKind::ggx, set.wi[s], set.wo[s]));
    p.retro.push_back(lobes::lobe_geometry(LobeKind::retro_ggx, set.wi[s], set.wo[s]));
    p.cos_i.push_back(set.wi[s].z);
    for (int g = 0; g < p.channels; ++g) {
      const ChannelGroup range = channel_group(set.channels, p.channels, g);
      double v = 0;
      for (int c = range.begin; c < range.end; ++c) v += set.values[s * from + static_cast<std::size_t>(c)] / p.scale;
      v /= range.end - range.begin;
      p.value.push_back(v);
      p.log_target.push_back(std::log(v * set.wi[s].z + log_offset));
    }
  }
  return p;
}

}  // namespace brdf::fit

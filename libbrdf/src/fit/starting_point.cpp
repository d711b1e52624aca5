// SPDX-License-Identifier: Apache-2.0
#include "fit/starting_point.h"

#include "lobes/lambert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace brdf::fit {
namespace {

const std::vector<lobes::LobeGeometry>& geometry_of(const PreparedSamples& samples, LobeKind kind) noexcept {
  return kind == LobeKind::retro_ggx ? samples.retro : samples.mirror;
}

/// max(0, value - present) of every sample and channel.
std::vector<double> left_over(const PreparedSamples& samples, std::size_t count, const LobeSet& present) {
  const auto channels = static_cast<std::size_t>(samples.channels);
  std::vector<double> rest(samples.value.begin(),
                           samples.value.begin() + static_cast<std::ptrdiff_t>(count * channels));
  for (const Lobe& lobe : present.lobes) {
    for (std::size_t s = 0; s < count; ++s) {
      const lobes::LobeGeometry& g = geometry_of(samples, lobe.kind)[s];
      const double shape = lobe.kind == LobeKind::lambert ? 0 : lobes::ggx_shape(g, lobe.alpha);
      for (std::size_t c = 0; c < channels; ++c) {
        rest[s * channels + c] -= lobe.kind == LobeKind::lambert
                                      ? lobes::lambert(lobe.color[c])
                                      : shape * lobes::schlick(lobe.color[c], lobe.f90, g.schlick_weight);
      }
    }
  }
  for (double& v : rest) v = std::max(v, 0.0);
  return rest;
}

/// alpha from the width of the peak: D falls to a quarter of its maximum where tan theta_h = alpha (Walter et al. 2007
/// eq. 33). Away from grazing 4 cos_i cos_o f follows D.
double visible_alpha(const PreparedSamples& samples, const std::vector<lobes::LobeGeometry>& geometry,
                     const std::vector<double>& rest, std::size_t count) {
  constexpr std::size_t bins = 40;
  std::array<double, bins> sum{}, weight{};
  const auto channels = static_cast<std::size_t>(samples.channels);
  const auto theta_h = [](const lobes::LobeGeometry& g) {
    return std::atan2(std::sqrt(g.sin2_theta_h), std::sqrt(g.cos2_theta_h));
  };
  for (std::size_t s = 0; s < count; ++s) {
    const lobes::LobeGeometry& g = geometry[s];
    if (g.cos_low < 0.4 || g.schlick_weight > 0.05) continue;
    const double t = std::sqrt(theta_h(g) * (2 / lobes::pi));
    const std::size_t b = std::min(static_cast<std::size_t>(t * bins), bins - 1);
    for (std::size_t c = 0; c < channels; ++c) {
      sum[b] += samples.weight[s] * rest[s * channels + c] * g.cos_low * g.cos_high;
    }
    weight[b] += samples.weight[s];
  }
  double peak = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    if (weight[b] > 0) peak = std::max(peak, sum[b] / weight[b]);
  }
  std::size_t last = bins / 2;
  if (peak > 0) {
    for (std::size_t b = 0; b < bins; ++b) {
      if (weight[b] > 0 && sum[b] / weight[b] >= peak / 4) last = b;
    }
  }
  const double t = (static_cast<double>(last) + 0.5) / bins;
  return std::tan(std::min(t * t * (lobes::pi / 2), 0.78));
}

}  // namespace

Lobe starting_lambert(const PreparedSamples& samples) {
  const auto channels = static_cast<std::size_t>(samples.channels);
  Lobe lobe;
  for (std::size_t c = 0; c < channels; ++c) {
    double sum = 0, weight = 0;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      sum += samples.weight[s] * (samples.log_target[s * channels + c] - std::log(samples.cos_i[s]));
      weight += samples.weight[s];
    }
    lobe.color.push_back(std::exp(sum / weight) / lobes::inv_pi);
  }
  return lobe;
}

Lobe starting_ggx(const PreparedSamples& samples, std::size_t count, const LobeSet& present, LobeKind kind, int start) {
  const auto channels = static_cast<std::size_t>(samples.channels);
  const std::vector<lobes::LobeGeometry>& geometry = geometry_of(samples, kind);
  const std::vector<double> rest = left_over(samples, count, present);

  Lobe lobe;
  lobe.kind = kind;
  // 1, 3, 1/3, 9, 1/9, ... times the visible width; what leaves the useful range comes in again at its other end
  const int step = (start + 1) / 2 * (start % 2 == 1 ? 1 : -1);
  const double low = std::log(2e-3), high = std::log(0.9);
  double log_alpha = std::log(visible_alpha(samples, geometry, rest, count)) + step * std::log(3.0);
  while (log_alpha > high) log_alpha -= high - low;
  while (log_alpha < low) log_alpha += high - low;
  lobe.alpha = std::exp(log_alpha);

  // colour = mean log ratio in the core of the peak, where the lobe should explain everything that is left over
  std::vector<double> sum(channels);
  double weight = 0;
  for (std::size_t s = 0; s < count; ++s) {
    const lobes::LobeGeometry& g = geometry[s];
    if (g.sin2_theta_h > lobe.alpha * lobe.alpha || g.schlick_weight > 0.05) continue;
    const double shape = lobes::ggx_shape(g, lobe.alpha);
    for (std::size_t c = 0; c < channels; ++c) {
      sum[c] += samples.weight[s] * std::log((rest[s * channels + c] + log_offset / samples.cos_i[s]) / shape);
    }
    weight += samples.weight[s];
  }
  for (std::size_t c = 0; c < channels; ++c) lobe.color.push_back(weight > 0 ? std::exp(sum[c] / weight) : 0.1);
  lobe.f90 = 4 * *std::max_element(lobe.color.begin(), lobe.color.end());  // between a metal's 1 and a plastic's 25
  return lobe;
}

}  // namespace brdf::fit

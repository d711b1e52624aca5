// SPDX-License-Identifier: Apache-2.0
#include "metrics/pair_errors.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace brdf::metrics {
namespace {

constexpr double tail_share = 0.95;

/// Weighted means of one per-pair error: per band, and over the bands below 85 degrees.
template <class T>
std::pair<double, std::array<double, band_ends.size()>> banded_means(const QuerySet& set, std::span<const T> error) {
  std::array<double, band_ends.size()> sum{}, weight{}, mean{};
  for (std::size_t i = 0; i < set.pairs; ++i) {
    sum[set.pair_band[i]] += set.pair_weight[i] * static_cast<double>(error[i]);
    weight[set.pair_band[i]] += set.pair_weight[i];
  }
  double all = 0, total = 0;
  for (std::size_t b = 0; b < mean.size(); ++b) {
    mean[b] = weight[b] > 0 ? sum[b] / weight[b] : 0;
    if (b > last_headline_band) continue;
    all += sum[b];
    total += weight[b];
  }
  return {all / total, mean};
}

/// 95th percentile and largest of one per-pair error below 85 degrees.
std::pair<double, double> tail(const QuerySet& set, std::span<const float> error) {
  std::vector<float> values;
  std::vector<double> weights;
  values.reserve(set.pairs);
  weights.reserve(set.pairs);
  for (std::size_t i = 0; i < set.pairs; ++i) {
    if (set.pair_band[i] > last_headline_band) continue;
    values.push_back(error[i]);
    weights.push_back(set.pair_weight[i]);
  }
  return {weighted_quantile(values, weights, tail_share),
          static_cast<double>(*std::max_element(values.begin(), values.end()))};
}

}  // namespace

void to_cosine_weighted(const QuerySet& set, std::size_t first_row, std::size_t count, int channels,
                        float* f) noexcept {
  const auto n = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < n; ++c) f[i * n + c] = std::max(f[i * n + c], 0.0f) * set.wi[first_row + i].z;
}

void PairErrors::compare(std::size_t first, std::size_t count, int channels, std::span<const float> reference,
                         std::span<const float> candidate) noexcept {
  const auto n = static_cast<std::size_t>(channels);
  const double share = 1.0 / channels;
  for (std::size_t i = 0; i < count; ++i) {
    double log_sum = 0, cbrt_sum = 0, cbrt_squares = 0, cos_squares = 0;
    for (std::size_t c = i * n; c < (i + 1) * n; ++c) {
      const double a = static_cast<double>(reference[c]), b = static_cast<double>(candidate[c]);
      if (a == b) continue;
      const double d = std::cbrt(a) - std::cbrt(b);
      log_sum += std::abs(std::log1p((a - b) / (1 + b)));  // = |log(1 + a) - log(1 + b)| with one logarithm
      cbrt_sum += std::abs(d);
      cbrt_squares += d * d;
      cos_squares += (a - b) * (a - b);
    }
    log_abs[first + i] = static_cast<float>(log_sum * share);
    cbrt_abs[first + i] = static_cast<float>(cbrt_sum * share);
    cbrt_square[first + i] = cbrt_squares * share;
    cos_square[first + i] = cos_squares * share;
  }
}

void PairErrors::summarize(const QuerySet& set, ErrorReport& report) const {
  std::tie(report.log_mae.all, report.log_mae.band) = banded_means<float>(set, log_abs);
  std::tie(report.log_mae.p95, report.log_mae.max) = tail(set, log_abs);
  std::tie(report.cbrt_rms.all, report.cbrt_rms.band) = banded_means<double>(set, cbrt_square);
  report.cbrt_rms.all = std::sqrt(report.cbrt_rms.all);
  for (double& b : report.cbrt_rms.band) b = std::sqrt(b);
  std::tie(report.cbrt_rms.p95, report.cbrt_rms.max) = tail(set, cbrt_abs);
  report.cos_l2 = std::sqrt(banded_means<double>(set, cos_square).first);
}

double weighted_quantile(std::span<const float> values, std::span<const double> weights, double share) {
  std::vector<std::pair<float, double>> items(values.size());
  double total = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    items[i] = {values[i], weights[i]};
    total += weights[i];
  }
  double below = 0;  // weight of what was found to lie before `from`
  const double wanted = share * total;
  auto from = items.begin(), to = items.end();
  while (to - from > 1) {
    const auto middle = from + (to - from) / 2;
    std::nth_element(from, middle, to);
    double left = 0;
    for (auto it = from; it != middle; ++it) left += it->second;
    if (below + left >= wanted) {
      to = middle;
    } else {
      below += left;
      from = middle;
    }
  }
  return static_cast<double>(from->first);
}

}  // namespace brdf::metrics

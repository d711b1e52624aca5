// SPDX-License-Identifier: Apache-2.0
// Errors over pairs against independent quadrature.
#include "metrics/pair_errors.h"

#include <brdf/metrics.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace brdf;
constexpr double pi = std::numbers::pi;

BatchEval constant(float value) {
  return [value](auto, auto, std::span<float> out) { std::fill(out.begin(), out.end(), value); };
}

/// Mean of g(cos_i) over independent cos_i and cos_o, both uniform (that is, uniform in solid angle), with the smaller
/// one between the cosines of two angles. Midpoint rule over cos_i, exact over cos_o.
template <class G>
double mean_in_band(double from_degrees, double to_degrees, G&& g) {
  const double high = std::cos(from_degrees * pi / 180), low = std::cos(to_degrees * pi / 180);
  constexpr int n = 2000;
  double sum = 0, weight = 0;
  for (int a = 0; a < n; ++a) {
    const double ci = (a + 0.5) / n;
    if (ci <= low) continue;
    // share of cos_o for which the smaller cosine lies in (low, high]
    const double share = ci <= high ? 1 - low : high - low;
    sum += share * g(ci);
    weight += share;
  }
  return sum / weight;
}

TEST(PairErrors, ScaledLambertMatchesQuadratureInEveryBand) {
  const double f = 0.8 / pi, d = 0.05;
  const Comparison c(constant(static_cast<float>(f)), 1);
  const ErrorReport r = c.score(constant(static_cast<float>(f * (1 + d))));
  const auto log_error = [&](double ci) { return std::abs(std::log(1 + f * ci) - std::log(1 + f * (1 + d) * ci)); };
  const auto first_order = [&](double ci) { return d * f * ci / (1 + f * ci); };
  const auto cbrt_error = [&](double ci) { return std::cbrt(f * (1 + d) * ci) - std::cbrt(f * ci); };
  const auto cbrt_square = [&](double ci) { return cbrt_error(ci) * cbrt_error(ci); };
  EXPECT_NEAR(r.log_mae.all, mean_in_band(0, 85, log_error), 2e-3 * r.log_mae.all);
  EXPECT_NEAR(r.log_mae.all, mean_in_band(0, 85, first_order), 1e-2 * r.log_mae.all);
  EXPECT_NEAR(r.cbrt_rms.all, std::sqrt(mean_in_band(0, 85, cbrt_square)), 2e-3 * r.cbrt_rms.all);
  EXPECT_NEAR(r.cos_l2, std::sqrt(mean_in_band(0, 85, [&](double ci) { return f * d * ci * f * d * ci; })),
              2e-3 * r.cos_l2);
  const std::array<double, 5> ends{0, 60, 75, 85, 90};
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_NEAR(r.log_mae.band[b], mean_in_band(ends[b], ends[b + 1], log_error), 1e-2 * r.log_mae.band[b]) << b;
    EXPECT_NEAR(r.cbrt_rms.band[b], std::sqrt(mean_in_band(ends[b], ends[b + 1], cbrt_square)),
                1e-2 * r.cbrt_rms.band[b])
        << b;
  }
  // cos_i is uniform between cos 85 degrees and 1, and the error grows with it
  const double c85 = std::cos(85 * pi / 180);
  EXPECT_NEAR(r.log_mae.p95, log_error(c85 + 0.95 * (1 - c85)), 2e-3 * r.log_mae.p95);
  EXPECT_NEAR(r.log_mae.max, log_error(1), 1e-3 * r.log_mae.max);
  EXPECT_NEAR(r.cbrt_rms.p95, cbrt_error(c85 + 0.95 * (1 - c85)), 2e-3 * r.cbrt_rms.p95);
  EXPECT_NEAR(r.cbrt_rms.max, cbrt_error(1), 1e-3 * r.cbrt_rms.max);
}

TEST(PairErrors, ErrorsBeyond85DegreesAreReportedApart) {
  const double c85 = std::cos(85 * pi / 180);
  const BatchEval grazing = [c85](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    for (std::size_t i = 0; i < wi.size(); ++i)
      out[i] = static_cast<double>(std::min(wi[i].z, wo[i].z)) <= c85 ? 2.0f : 0.3f;
  };
  const ErrorReport r = Comparison(constant(0.3f), 1, 0.05).score(grazing);
  EXPECT_EQ(r.log_mae.all, 0);
  EXPECT_EQ(r.log_mae.max, 0);
  EXPECT_EQ(r.cbrt_rms.all, 0);
  EXPECT_EQ(r.cos_l2, 0);
  EXPECT_GT(r.log_mae.band[3], 0.1);
}

TEST(PairErrors, ChannelsAreAveraged) {
  const auto planes = [](float a, float b) -> BatchEval {
    return [a, b](auto, auto, std::span<float> out) {
      for (std::size_t i = 0; i < out.size(); i += 2) out[i] = a, out[i + 1] = b;
    };
  };
  const ErrorReport both = Comparison(planes(0.2f, 0.5f), 2, 0.02).score(planes(0.25f, 0.4f));
  const ErrorReport first = Comparison(constant(0.2f), 1, 0.02).score(constant(0.25f));
  const ErrorReport second = Comparison(constant(0.5f), 1, 0.02).score(constant(0.4f));
  EXPECT_NEAR(both.log_mae.all, (first.log_mae.all + second.log_mae.all) / 2, 1e-6);
  EXPECT_NEAR(both.cbrt_rms.all, std::sqrt((std::pow(first.cbrt_rms.all, 2) + std::pow(second.cbrt_rms.all, 2)) / 2),
              1e-6);
  EXPECT_NEAR(both.cos_l2, std::sqrt((std::pow(first.cos_l2, 2) + std::pow(second.cos_l2, 2)) / 2), 1e-6);
}

TEST(PairErrors, NegativeValuesCountAsZero) {
  const ErrorReport negative = Comparison(constant(0.3f), 1, 0.02).score(constant(-0.2f));
  const ErrorReport zero = Comparison(constant(0.3f), 1, 0.02).score(constant(0.0f));
  EXPECT_EQ(negative.log_mae.all, zero.log_mae.all);
  EXPECT_EQ(negative.cbrt_rms.all, zero.cbrt_rms.all);
  EXPECT_GT(negative.negative, 0u);
  EXPECT_EQ(zero.negative, 0u);
}

TEST(WeightedQuantile, AgreesWithSorting) {
  std::mt19937 bits(7);
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{1000}}) {
    std::vector<float> values(n);
    std::vector<double> weights(n);
    std::vector<std::size_t> order(n);
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = static_cast<float>(bits() % 97);  // with ties
      weights[i] = 1 + static_cast<double>(bits() % 1000);
      order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    double total = 0;
    for (const double w : weights) total += w;
    for (const double share : {0.05, 0.5, 0.95, 1.0}) {
      double below = 0;
      std::size_t k = 0;
      while (k + 1 < n && below + weights[order[k]] < share * total) below += weights[order[k++]];
      EXPECT_EQ(metrics::weighted_quantile(values, weights, share), static_cast<double>(values[order[k]]))
          << n << ' ' << share;
    }
  }
}

}  // namespace

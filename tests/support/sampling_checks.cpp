// SPDX-License-Identifier: Apache-2.0
#include "support/sampling_checks.h"

#include "lobes/lobe_kinds.h"
#include "support/chi_squared.h"
#include "support/map_quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace brdf::test {

std::vector<Vec3f> sampling_views() {
  std::vector<Vec3f> w;
  for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0, 85.0, 89.0, 89.9})
    w.push_back(direction_at(std::cos(degrees * std::numbers::pi / 180), 0.7 + degrees));
  return w;
}

Draws draw(const Material& m, const Vec3f& wo, std::size_t n, std::uint32_t seed) {
  const DirectionBatch u = random_numbers(n, seed);
  const auto channels = static_cast<std::size_t>(m.channels());
  DirectionBatch view(n);
  for (std::size_t i = 0; i < n; ++i) view.x[i] = wo.x, view.y[i] = wo.y, view.z[i] = wo.z;
  Draws d{DirectionBatch(n), std::vector<float>(n), std::vector<double>(n, 0.0)};
  std::vector<float> weight(n * channels);
  m.sample(view.span(), u.span(), d.wi.writable(), d.pdf.data(), {weight.data(), n});
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t i = 0; i < n; ++i) d.weight[i] += static_cast<double>(weight[c * n + i]) / static_cast<double>(channels);
  return d;
}

namespace {

/// How far the azimuth of a half vector at the width of the narrowest lobe is off because directions are floats, as a
/// multiple of the range over which the horizon's height over the azimuth changes sides, which is cos_o. Above 1 the
/// density of a pair of floats is that of a neighbour.
double azimuth_noise(const Material& m, double cos_o) {
  double alpha = 1;
  for (const Lobe& l : m.lobes().lobes)
    if (l.kind != LobeKind::lambert) alpha = std::min(alpha, l.alpha);
  return 6e-8 / (alpha * 2 * cos_o * cos_o);
}

}  // namespace

void expect_sampling(const Material& m, const Vec3f& wo, std::size_t samples, double p_threshold) {
  const Draws d = draw(m, wo, samples, 77);
  const HemisphereGrid grid;
  const CellIntegrals integrals = integrate(m, wo, grid, lobes::has_retro_lobes(m.lobes()));
  std::vector<double> observed(grid.cells(), 0.0), expected = integrals.pdf;
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    sum += d.weight[i];
    square += d.weight[i] * d.weight[i];
    ASSERT_TRUE(std::isfinite(d.pdf[i]) && std::isfinite(d.weight[i]));
    ASSERT_GT(d.pdf[i], 0);
    ASSERT_GE(d.weight[i], 0);
    ASSERT_GT(d.wi.z[i], 0);
    ++observed[grid.cell_of(d.wi[i])];
  }
  const double count = static_cast<double>(samples), total = std::accumulate(expected.begin(), expected.end(), 0.0);
  EXPECT_NEAR(total, 1, azimuth_noise(m, static_cast<double>(wo.z)) < 1 ? 1e-3 : 0.06);
  for (double& e : expected) e *= count / total;
  EXPECT_GT(chi_squared_p_value(observed, expected), p_threshold);

  const double mean = sum / count, error = std::sqrt(std::max(square / count - mean * mean, 0.0) / count);
  const double integral = std::accumulate(integrals.f_cos.begin(), integrals.f_cos.end(), 0.0);
  // the second term is the error of the quadrature
  EXPECT_NEAR(mean, integral, 4 * error + 1e-4 * integral);
  std::vector<float> albedo(static_cast<std::size_t>(m.channels()));
  m.albedo(wo, albedo);
  const double mean_albedo = std::accumulate(albedo.begin(), albedo.end(), 0.0) / static_cast<double>(albedo.size());
  EXPECT_NEAR(mean_albedo, integral, (wo.z > 0.1f ? 2e-3 : 1e-2) * integral);
}

WeightSpread weight_spread(const Material& m, const Vec3f& wo, std::size_t samples) {
  const Draws d = draw(m, wo, samples, 8);
  double sum = 0, square = 0, largest = 0;
  for (const double w : d.weight) {
    sum += w;
    square += w * w;
    largest = std::max(largest, w);
  }
  const double count = static_cast<double>(samples), mean = sum / count;
  return {largest / mean, std::sqrt(std::max(square / count - mean * mean, 0.0)) / mean};
}

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// Distributions of rows without anything in them, of one cell that holds it all, of sums that underflow; and many samples.
#include "support/direction_batch.h"
#include "support/numeric_bound.h"
#include "support/simd_targets.h"
#include "support/synthetic_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace brdf::test {
namespace {

const char* const group = "Sampling";
NumericBound odd(group, "degenerate densities, corners of the unit cube: samples not sound", "count", 0);
NumericBound many(group, "ten million samples, random directions: samples not sound", "count", 0);
NumericBound many_extreme(group, "ten million samples, extreme directions: samples not sound", "count", 0);
NumericBound unit_length(group, "length of drawn directions from 1", "absolute", 2e-6);
NumericBound same_pdf(group, "pdf() of a drawn direction against the density of its draw, alpha 0.1 and rougher, theta below 89 degrees", "relative", 2e-3);

struct NamedMaterial {
  std::string name;
  Material material;
};

std::vector<NamedMaterial> materials() {
  residual::ResidualGrid spiky = synthetic_grid({24, 16, 12, 3, true});
  std::fill(spiky.ratio.begin(), spiky.ratio.end(), residual::half_min_normal);
  spiky.ratio[spiky.ratio.size() / 2] = residual::half_max;
  return {{"nothing at all", material_of({3, {}})},
          {"black lobes", material_of({3, {lambert_lobe(3, 0), ggx_lobe(3, 0.2, 0, 0)}})},
          {"alpha 1e-5", material_of({3, {ggx_lobe(3, 1e-5, 0.9)}})},
          {"alpha 1e-5, retro", material_of({3, {ggx_lobe(3, 1e-5, 0.9, 1, true)}})},
          {"colours of 1e-38", material_of({3, {lambert_lobe(3, 1e-38), ggx_lobe(3, 0.3, 1e-38, 1e-38)}})},
          {"colours of 1e-45", material_of({3, {lambert_lobe(3, 1e-45), ggx_lobe(3, 1e-3, 1e-45, 0)}})},
          {"colours of 1e30", material_of({3, {lambert_lobe(3, 1e30), ggx_lobe(3, 1e-4, 1e30, 1e30)}})},
          {"one node holds it all", material_of({3, {lambert_lobe(3, 0.5)}}, spiky)},
          {"usual", material_of(usual_lobes())},
          {"usual with a residual", material_of(usual_lobes(), synthetic_grid({}))}};
}

/// Draws a batch and counts what is not sound: numbers that are not finite, negative ones, a direction at or below the
/// horizon, no density where a direction was returned, or no direction for a view above the horizon.
double unsound(const Material& m, const DirectionBatch& wo, const DirectionBatch& u, DirectionBatch& wi) {
  const std::size_t n = wo.size(), channels = static_cast<std::size_t>(m.channels());
  static std::vector<float> pdf, weight;
  pdf.assign(n, -1.0f);
  weight.assign(channels * n, -1.0f);
  m.sample(wo.span(), u.span(), wi.writable(), pdf.data(), {weight.data(), n});
  double count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f w = wi[i];
    const bool drawn = w.x != 0 || w.y != 0 || w.z != 0, expected = wo.z[i] > 0;
    bool good = drawn == expected && std::isfinite(pdf[i]) && (drawn ? pdf[i] > 0 && w.z > 0 : pdf[i] == 0);
    for (std::size_t c = 0; c < channels; ++c) good = good && std::isfinite(weight[c * n + i]) && weight[c * n + i] >= 0;
    count += good ? 0 : 1;
    if (!drawn) continue;
    const double x = w.x, y = w.y, z = w.z;
    unit_length.see(std::fabs(std::sqrt(x * x + y * y + z * z) - 1), [&] { return numbers({x, y, z}); });
  }
  return count;
}

const float below_one = std::nextafter(1.0f, 0.0f);

DirectionBatch extreme_views() {
  DirectionBatch wo;
  for (const float cosine : {1.0f, 0.9999999f, 0.999f, 0.5f, 1e-2f, 1e-4f, 1.7e-7f, 1e-12f, 1e-30f, 1e-45f, 0.0f, -0.3f})
    for (const float phi : {0.0f, 1.1f, 3.1415927f}) {
      const float s = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
      wo.push({s * std::cos(phi), s * std::sin(phi), cosine});
    }
  return wo;
}

TEST(Sampling, DegenerateDensitiesAtTheCornersOfTheUnitCube) {
  const DirectionBatch views = extreme_views();
  DirectionBatch wo, u;
  const float corners[] = {0.0f, std::numeric_limits<float>::denorm_min(), 1e-20f, 1e-7f, 0.25f, 0.5f, 0.5000001f, 0.9999f, below_one};
  for (std::size_t k = 0; k < views.size(); ++k)
    for (const float a : {0.0f, 0.5f, below_one})
      for (const float b : corners)
        for (const float c : corners) {
          wo.push(views[k]);
          u.push({a, b, c});
        }
  double count = 0;
  for (const NamedMaterial& m : materials()) {
    on_every_target([&] {
      DirectionBatch wi(wo.size());
      count += unsound(m.material, wo, u, wi);
      odd.see(count, [&] { return m.name + ", " + simd_target(); });
    });
    std::vector<float> weight(3);
    for (std::size_t i = 0; i < wo.size(); ++i) {
      const Sample s = m.material.sample(wo[i], u[i], weight);
      const bool good = (s.pdf > 0) == (wo.z[i] > 0) && std::isfinite(s.pdf) && (s.pdf == 0 || s.wi.z > 0) &&
                        std::isfinite(weight[0]) && weight[0] >= 0;
      count += good ? 0 : 1;
      odd.see(count, [&] { return m.name + ", one at a time"; });
    }
  }
  odd.check();
}

/// Ten million samples over all materials, in batches; `next` fills views and numbers.
template <class Next>
void draw_ten_million(NumericBound& bound, const Next& next) {
  constexpr std::size_t batch = 8192;
  const std::vector<NamedMaterial> all = materials();
  const std::size_t rounds = 10'000'000 / (batch * all.size()) + 1;
  double count = 0;
  DirectionBatch wo(batch), u(batch), wi(batch);
  for (const NamedMaterial& m : all)
    for (std::size_t round = 0; round < rounds; ++round) {
      next(round, wo, u);
      count += unsound(m.material, wo, u, wi);
      bound.see(count, [&] { return m.name + ", batch " + std::to_string(round); });
    }
  bound.check();
}

TEST(Sampling, TenMillionSamplesAtRandomDirections) {
  draw_ten_million(many, [](std::size_t round, DirectionBatch& wo, DirectionBatch& u) {
    const auto seed = static_cast<std::uint32_t>(round);
    wo = random_directions(wo.size(), 2 * seed + 100);
    u = random_numbers(u.size(), 2 * seed + 101);
  });
  unit_length.check();
}

TEST(Sampling, TenMillionSamplesAtExtremeDirections) {
  const DirectionBatch views = extreme_views();
  draw_ten_million(many_extreme, [&](std::size_t round, DirectionBatch& wo, DirectionBatch& u) {
    const std::size_t n = wo.size();
    u = random_numbers(n, static_cast<std::uint32_t>(round) + 5000);
    wo = DirectionBatch();
    for (std::size_t i = 0; i < n; ++i) wo.push(views[(i + round) % views.size()]);
    for (std::size_t i = 0; i < n; i += 16) u.y[i] = i % 32 == 0 ? 0.0f : below_one;
    for (std::size_t i = 0; i < n; i += 24) u.z[i] = i % 48 == 0 ? 0.0f : below_one;
  });
}

TEST(Sampling, PdfIsTheDensityOfTheDraw) {
  const std::size_t n = 20000;
  for (const LobeSet& lobes : {usual_lobes(), LobeSet{3, {ggx_lobe(3, 0.1, 0.9)}}, LobeSet{3, {lambert_lobe(3, 0.7)}}}) {
    const Material m = material_of(lobes);
    DirectionBatch wo = random_directions(n, 61), u = random_numbers(n, 62), wi(n);
    std::vector<float> drawn(n), pdf(n), weight(3 * n);
    on_every_target([&] {
      m.sample(wo.span(), u.span(), wi.writable(), drawn.data(), {weight.data(), n});
      m.pdf(wi.span(), wo.span(), pdf.data());
      for (std::size_t i = 0; i < n; ++i) {
        if (wo.z[i] < 0.0175f || wi.z[i] < 0.0175f) continue;
        same_pdf.see(std::fabs(static_cast<double>(pdf[i]) / static_cast<double>(drawn[i]) - 1),
                     [&] { return "wo " + numbers({wo.x[i], wo.y[i], wo.z[i]}) + ", u " + numbers({u.y[i], u.z[i]}) + ", " + simd_target(); });
      }
    });
  }
  same_pdf.check();
}

}  // namespace
}  // namespace brdf::test

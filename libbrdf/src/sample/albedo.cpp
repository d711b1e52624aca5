// SPDX-License-Identifier: Apache-2.0
#include "sample/albedo.h"

#include "sample/batch_sample.h"
#include "sample/square_lattice.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace brdf::sample {

namespace {

constexpr std::size_t strata = 96;  ///< along each number

/// Channels that one pass keeps on the stack, and the weights of one call.
constexpr std::size_t max_channels = 1024, max_weights = 16384;

/// Each channel is a mixture of the same two means, so their number does not matter.
void albedo_of(const analytic::GgxScatter& s, const Vec3f& wo, std::span<float> a) noexcept {
  analytic::GgxScatter::Parts mean;
  constexpr double share = 1.0 / (strata * strata);
  for (std::size_t row = 0; row < strata; ++row)
    for (std::size_t column = 0; column < strata; ++column) {
      const auto weight = s.facet_weight(wo, lattice_point(row, column, strata));
      mean.plain += share * weight.plain;
      mean.white += share * weight.white;
    }
  for (std::size_t c = 0; c < a.size(); ++c) a[c] = static_cast<float>(s.albedo(c, wo, mean));
}

}  // namespace

void albedo(const analytic::Scatterer& s, const Vec3f& wo, std::span<float> a) noexcept {
  if (const auto* facets = std::get_if<analytic::GgxScatter>(&s)) return albedo_of(*facets, wo, a);
  if (const auto* mirror = std::get_if<analytic::MirrorScatter>(&s)) return mirror->albedo(wo, a);
  if (const auto* glass = std::get_if<analytic::DielectricScatter>(&s)) return glass->albedo(wo, a);
}

void albedo(const eval::Tables& t, const Material::Sampling* s, const Vec3f& wo, std::span<float> a) noexcept {
  const auto channels = static_cast<std::size_t>(t.lobes.channels);
  a = a.first(channels);
  std::fill(a.begin(), a.end(), 0.0f);
  if (!(wo.z > 0.0f) || channels > max_channels) return;
  const std::size_t step = std::min(strata, max_weights / channels);
  std::array<float, strata> wo_x, wo_y, wo_z, u_x, u_y, u_z, x, y, z, pdf;
  std::array<float, max_weights> weight;
  std::array<double, max_channels> sum;
  std::fill_n(sum.begin(), channels, 0.0);
  wo_x.fill(wo.x);
  wo_y.fill(wo.y);
  wo_z.fill(wo.z);
  for (std::size_t row = 0; row < strata; ++row) {
    for (std::size_t first = 0; first < strata; first += step) {
      const std::size_t size = std::min(step, strata - first);
      for (std::size_t i = 0; i < size; ++i) {
        const Vec3f u = lattice_point(row, first + i, strata);
        u_x[i] = u.x, u_y[i] = u.y, u_z[i] = u.z;
      }
      sample_batch(t, s, {wo_x.data(), wo_y.data(), wo_z.data(), size}, {u_x.data(), u_y.data(), u_z.data(), size},
                   {x.data(), y.data(), z.data(), size}, pdf.data(), {weight.data(), size});
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < size; ++i) sum[c] += static_cast<double>(weight[c * size + i]);
    }
  }
  for (std::size_t c = 0; c < channels; ++c) a[c] = static_cast<float>(sum[c] / (strata * strata));
}

}  // namespace brdf::sample

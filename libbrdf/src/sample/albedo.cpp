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

}  // namespace

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

// SPDX-License-Identifier: Apache-2.0
#include "sample/albedo.h"

#include "sample/batch_sample.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace brdf::sample {

namespace {

constexpr std::size_t strata = 96;  ///< along each number

/// Channels that one pass keeps on the stack, and the weights of one call.
constexpr std::size_t max_channels = 1024, max_weights = 16384;

}  // namespace

/// One point in each of equal squares of (u.y, u.z). Its place in the square walks by golden steps along the row and along
/// the column, so that each number alone takes evenly spread values too: much of what is integrated depends on one of
/// them only. The choice of the component walks along the diagonals.
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
  const auto golden = [](std::size_t n) {
    const double turns = (static_cast<double>(n) + 0.5) * 0.61803398874989485;
    return static_cast<float>(turns - static_cast<double>(static_cast<int>(turns)));
  };
  for (std::size_t row = 0; row < strata; ++row) {
    for (std::size_t first = 0; first < strata; first += step) {
      const std::size_t size = std::min(step, strata - first);
      for (std::size_t i = 0; i < size; ++i) {
        u_x[i] = golden(first + i + row);
        u_y[i] = (static_cast<float>(row) + golden(first + i)) / strata;
        u_z[i] = (static_cast<float>(first + i) + golden(row)) / strata;
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

// SPDX-License-Identifier: Apache-2.0
#include "sample/albedo.h"

#include "eval/scalar_eval.h"
#include "eval/single_eval.h"
#include "eval/warp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brdf::sample {

namespace {

constexpr std::size_t budget = 4096;
constexpr std::size_t max_components = eval::max_ggx_lobes + 1;

/// Channels that one pass keeps on the stack.
constexpr std::size_t max_channels = 1024;

}  // namespace

/// Every component draws a fixed number of low-discrepancy points (R2 sequence, Roberts 2018), and each point counts with
/// the balance heuristic over all components (Veach and Guibas 1995), so no choice of component adds noise.
void albedo(const eval::Tables& t, const Vec3f& wo, std::span<float> a) noexcept {
  a = a.first(static_cast<std::size_t>(t.lobes.channels));
  std::fill(a.begin(), a.end(), 0.0f);
  if (!(wo.z > 0.0f) || a.size() > max_channels) return;
  const std::size_t n = t.lobes.ggx.size() + 1, each = budget / n;
  std::array<float, max_components> density{};
  std::array<float, max_channels> f;
  std::array<double, max_channels> sum;
  std::fill_n(sum.begin(), a.size(), 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < each; ++j) {
      const double i = 0.5 + static_cast<double>(j);
      const auto u = static_cast<float>(i / static_cast<double>(each));
      const auto v = static_cast<float>(i * 0.61803398874989485 - std::floor(i * 0.61803398874989485));
      const Vec3f wi = k == 0 ? eval::cosine_direction(u, v) : eval::ggx_direction(t.lobes.ggx[k - 1], wo, u, v);
      if (!(wi.z > 0.0f)) continue;
      eval::component_densities(t.lobes, wi, wo, density);
      float total = 0;
      for (std::size_t c = 0; c < n; ++c) total += density[c];
      if (!(total > 0.0f)) continue;
      const std::span<float> values = std::span(f).first(a.size());
      eval::eval_single(t, wi, wo, values);
      const double w = static_cast<double>(wi.z / total);
      for (std::size_t c = 0; c < a.size(); ++c) sum[c] += static_cast<double>(values[c]) * w;
    }
  }
  for (std::size_t c = 0; c < a.size(); ++c) a[c] = static_cast<float>(sum[c] / static_cast<double>(each));
}

}  // namespace brdf::sample

// SPDX-License-Identifier: Apache-2.0
#include "encode/transform_choice.h"

#include "encode/scattered_pairs.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace brdf::encode {
namespace {

using residual::ChannelTransform;

constexpr int pairs = 1000;
constexpr double least_energy = 1e-5;  // of a log ratio: what is below costs no bits whatever the transform
constexpr double worth_it = 0.05;      // bits per coefficient

/// Half the sum of log2 of the energies after a transform; `product` holds the mean products of the channels.
double bits(ChannelTransform transform, const std::vector<double>& product, std::size_t n) {
  const std::vector<double> t = residual::channel_matrix(transform, static_cast<int>(n));
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double energy = 0;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) energy += t[i * n + a] * t[i * n + b] * product[a * n + b];
    sum += 0.5 * std::log2(std::max(energy, least_energy));
  }
  return sum / static_cast<double>(n);
}

}  // namespace

ChannelTransform decorrelating_transform(const Measurement& m, const LobeSet& lobes, double epsilon) {
  const auto n = static_cast<std::size_t>(m.channels.count);
  if (n == 1) return ChannelTransform::identity;
  const MeasurementInterpolator reference(m);
  std::vector<double> f(n), l(n), product(n * n, 0.0);
  int seen = 0;
  for_scattered_pairs(pairs, [&](const Vec3d& wi, const Vec3d& wo) {
    if (!reference.eval(wi, wo, f)) return;
    eval_lobes(lobes, wi, wo, l);
    for (std::size_t c = 0; c < n; ++c) l[c] = std::log((std::max(f[c], 0.0) + epsilon) / (l[c] + epsilon));
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b) product[a * n + b] += l[a] * l[b];
    ++seen;
  });
  for (double& p : product) p /= std::max(seen, 1);
  ChannelTransform best = n == 3 ? ChannelTransform::opponent : ChannelTransform::cosine;
  double least = bits(best, product, n) - worth_it;
  for (const ChannelTransform t : {ChannelTransform::identity, ChannelTransform::cosine}) {
    const double b = bits(t, product, n);
    if (b >= least) continue;
    least = b;
    best = t;
  }
  return best;
}

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
#include "eval/mixture.h"

#include "eval/scalar_eval.h"
#include "eval/single_eval.h"
#include "eval/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace brdf::eval {

namespace {

constexpr std::size_t max_components = max_ggx_lobes + 1;
constexpr std::size_t nodes = 10;         // directions wo at which the second moment is watched
constexpr std::size_t samples_each = 16;  // per component and node
constexpr int iterations = 12;
/// Least share of the cosine lobe. The grid may raise f anywhere, also where no lobe reaches; then f / pdf must stay
/// bounded. Lobes alone are covered by their own densities.
constexpr float floor_with_grid = 0.1f, floor_of_lobes = 1e-3f;
/// Least share of all GGX lobes together, so that none is lost to the noise of few samples.
constexpr float floor_of_ggx = 0.04f;

constexpr Mixture::Curve binomials = {1, 5, 10, 10, 5, 1};

using PerComponent = std::array<double, max_components>;

/// One sample of the balance-heuristic proposal q: (f cos)^2 / q and the densities of the components.
struct Probe {
  float g;
  std::array<float, max_components> density;
};

double mean(std::span<const float> values) noexcept {
  double sum = 0;
  for (float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

std::vector<Probe> probes_at(const Tables& t, const Vec3f& wo, std::span<float> f) {
  const LobeParams& lobes = t.lobes;
  const std::size_t n = lobes.ggx.size() + 1;
  std::vector<Probe> probes;
  probes.reserve(n * samples_each);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < samples_each; ++j) {
      const double point = 0.5 + static_cast<double>(j);
      const auto u = static_cast<float>(point / samples_each), v = static_cast<float>(std::fmod(point * 0.61803398875, 1.0));
      const Vec3f wi = k == 0 ? cosine_direction(u, v) : ggx_direction(lobes.ggx[k - 1], wo, u, v);
      if (!(wi.z > 0)) continue;
      Probe p{};
      component_densities(lobes, wi, wo, p.density);
      eval_single(t, wi, wo, f);
      const double q = mean(std::span(p.density).first(n)), value = mean(f) * static_cast<double>(wi.z);
      p.g = static_cast<float>(value / q * value);
      if (q > 0 && std::isfinite(p.g)) probes.push_back(p);
    }
  }
  return probes;
}

/// M_k = integral of (f cos)^2 p_k / pdf^2, scaled so that sum w_k M_k = 1.
PerComponent moments(std::span<const Probe> probes, const PerComponent& w, std::size_t n) noexcept {
  PerComponent m{};
  double total = 0;
  for (const Probe& p : probes) {
    double pdf = 0;
    for (std::size_t k = 0; k < n; ++k) pdf += w[k] * static_cast<double>(p.density[k]);
    const double share = static_cast<double>(p.g) / (pdf * pdf);
    for (std::size_t k = 0; k < n; ++k) m[k] += share * static_cast<double>(p.density[k]);
    total += share * pdf;
  }
  for (std::size_t k = 0; k < n; ++k) m[k] = total > 0 ? m[k] / total : (k == 0 ? 1 / w[0] : 0.0);
  return m;
}

}  // namespace

/// Weights with the least second moment of f cos / pdf, relative to its own size at each node. At the optimum all M_k of
/// a control point are equal, hence the fixed point b_k <- b_k sqrt(M_k). Integrals are sums over one set of
/// low-discrepancy samples (Roberts 2018) that every component contributes to alike.
Mixture::Mixture(const Tables& t) {
  const LobeParams& lobes = t.lobes;
  const std::size_t n = lobes.ggx.size() + 1;
  lobe.assign(n - 1, Curve{});
  if (n == 1) return;
  std::vector<float> f(static_cast<std::size_t>(lobes.channels));
  std::array<std::vector<Probe>, nodes> probes;
  std::array<Curve, nodes> basis;
  for (std::size_t i = 0; i < nodes; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / nodes;
    basis[i] = bernstein_powers(z);
    for (std::size_t j = 0; j < controls; ++j) basis[i][j] *= binomials[j];
    probes[i] = probes_at(t, {std::sqrt(1 - z * z), 0.0f, z}, f);
  }
  const double cosine_floor = static_cast<double>(t.grid.ratio || t.slices.values ? floor_with_grid : floor_of_lobes);
  const double lobe_floor = static_cast<double>(floor_of_ggx) / static_cast<double>(n - 1);
  std::array<PerComponent, controls> control;
  for (PerComponent& c : control) c.fill(1.0 / static_cast<double>(n));
  for (int round = 0; round < iterations; ++round) {
    std::array<PerComponent, controls> pull{};
    for (std::size_t i = 0; i < nodes; ++i) {
      PerComponent w{};
      for (std::size_t j = 0; j < controls; ++j)
        for (std::size_t k = 0; k < n; ++k) w[k] += static_cast<double>(basis[i][j]) * control[j][k];
      const PerComponent m = moments(probes[i], w, n);
      for (std::size_t j = 0; j < controls; ++j)
        for (std::size_t k = 0; k < n; ++k) pull[j][k] += static_cast<double>(basis[i][j]) * m[k];
    }
    for (std::size_t j = 0; j < controls; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += control[j][k] *= std::sqrt(pull[j][k]);
      const double room = 1 - cosine_floor - static_cast<double>(floor_of_ggx);
      for (std::size_t k = 0; k < n; ++k)
        control[j][k] = (k == 0 ? cosine_floor : lobe_floor) + room * control[j][k] / sum;
    }
  }
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t j = 0; j < controls; ++j)
      lobe[k - 1][j] = binomials[j] * static_cast<float>(control[j][k]);
}

}  // namespace brdf::eval

// SPDX-License-Identifier: Apache-2.0
// Residual grids, lobe sets and materials made up for tests and benchmarks of evaluation.
#pragma once

#include "eval/material_impl.h"
#include "residual/half_float.h"
#include "residual/residual_grid.h"
#include "sample/build_density.h"

#include <brdf/lobes.h>
#include <brdf/material.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>

namespace brdf::test {

struct GridShape {
  int n_h = 48, n_d = 28, n_p = 24, channels = 3;
  bool reciprocal = true;       ///< and mirror-symmetric, unless
  bool mirror_symmetric = true;
};

/// A smooth ratio around 1, times exp of noise of the given amplitude at every node.
inline residual::ResidualGrid synthetic_grid(const GridShape& shape, double noise = 0.1, std::uint32_t seed = 1) {
  residual::ResidualGrid g;
  g.n_h = shape.n_h;
  g.n_d = shape.n_d;
  g.n_p = shape.n_p;
  g.channels = shape.channels;
  g.azimuth = !shape.reciprocal        ? residual::Azimuth::one_way
              : shape.mirror_symmetric ? residual::Azimuth::symmetric
                                       : residual::Azimuth::reciprocal;
  g.kappa_h = 0.05f;
  g.kappa_d = 2.0f;
  g.epsilon = 0.01f;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int h = 0; h < g.n_h; ++h)
    for (int d = 0; d < g.n_d; ++d)
      for (int p = 0; p < g.n_p; ++p)
        for (int c = 0; c < g.channels; ++c) {
          const double x = h / 47.0, y = d / 27.0, z = p / 23.0;
          const double smooth = 0.5 * std::sin(5 * x + c) + 0.3 * std::cos(4 * y - 2 * z);
          g.ratio.push_back(residual::half_from_float(static_cast<float>(std::exp(smooth + noise * uniform(random)))));
        }
  if (g.azimuth == residual::Azimuth::reciprocal)  // phi_d is modulo pi: the last node is the first one
    for (std::size_t line = 0; line < g.ratio.size(); line += static_cast<std::size_t>(g.n_p * g.channels))
      std::copy_n(g.ratio.begin() + static_cast<std::ptrdiff_t>(line), g.channels,
                  g.ratio.begin() + static_cast<std::ptrdiff_t>(line) + (g.n_p - 1) * g.channels);
  // what lies behind the last node must not matter, so it is not a number that could pass for one
  g.ratio.insert(g.ratio.end(), 8, residual::half_max);  // finite, and anything but harmless where it is used
  return g;
}

inline Lobe lambert_lobe(int channels, double rho) {
  Lobe l;
  l.kind = LobeKind::lambert;
  for (int c = 0; c < channels; ++c) l.color.push_back(rho * (1 - 0.5 * c / channels));
  return l;
}

inline Lobe ggx_lobe(int channels, double alpha, double f0, double f90 = 1, bool retro = false) {
  Lobe l;
  l.kind = retro ? LobeKind::retro_ggx : LobeKind::ggx;
  l.alpha = alpha;
  l.f90 = f90;
  for (int c = 0; c < channels; ++c) l.color.push_back(f0 * (1 - 0.4 * c / channels));
  return l;
}

/// Lambert and two GGX lobes: what a fit usually finds.
inline LobeSet usual_lobes(int channels = 3) {
  return {channels, {lambert_lobe(channels, 0.3), ggx_lobe(channels, 0.08, 0.06), ggx_lobe(channels, 0.35, 0.1, 0.6)}};
}

/// A handle that is prepared for sampling.
inline Material with_sampling(std::shared_ptr<const Material::Impl> impl) {
  auto tables = sample::build_density(impl->lobes, impl->tables, impl->info.mirror_symmetric);
  return Material(std::move(impl), std::move(tables));
}

inline Material material_of(const LobeSet& lobes, residual::ResidualGrid grid = {}) {
  MaterialInfo info;
  info.channels.count = lobes.channels;
  info.reciprocal = grid.empty() || residual::is_reciprocal(grid.azimuth);
  const EvalLevel level = grid.empty() ? EvalLevel::fast : EvalLevel::balanced;
  return with_sampling(eval::make_impl(std::move(info), lobes, std::move(grid), level));
}

}  // namespace brdf::test

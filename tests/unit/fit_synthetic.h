// SPDX-License-Identifier: Apache-2.0
// Measurements whose lobes are known.
#pragma once

#include <brdf/lobes.h>
#include <brdf/measurement.h>

#include "geometry/half_difference.h"

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace brdf::fit {

inline constexpr double pi = 3.14159265358979323846;

/// Table of MERL layout holding `set` times `scale`, with log-normal noise of relative size `noise` on every value.
inline Measurement table_of(const LobeSet& set, double scale = 1, double noise = 0) {
  Measurement m;
  m.channels.count = set.channels;
  HalfDifferenceTable t;
  t.n_theta_h = 90, t.n_theta_d = 45, t.n_phi_d = 60;
  const auto channels = static_cast<std::size_t>(set.channels);
  std::vector<double> f(channels);
  std::mt19937_64 rng(7);
  std::normal_distribution<double> normal(0, 1);
  for (int i = 0; i < t.n_theta_h; ++i) {
    for (int j = 0; j < t.n_theta_d; ++j) {
      for (int k = 0; k < t.n_phi_d; ++k) {
        const double u = static_cast<double>(i) / t.n_theta_h;
        Vec3d wi, wo;
        geometry::directions_from_half_difference(u * u * pi / 2, j * pi / 2 / t.n_theta_d, k * pi / t.n_phi_d, wi, wo);
        t.valid.push_back(wi.z > 0.01 && wo.z > 0.01 ? 1 : 0);
        eval_lobes(set, wi, wo, f);
        for (const double v : f) {
          t.values.push_back(t.valid.back() == 0 ? -1.0F
                                                 : static_cast<float>(v * scale * std::exp(noise * normal(rng))));
        }
      }
    }
  }
  m.table = std::move(t);
  return m;
}

}  // namespace brdf::fit

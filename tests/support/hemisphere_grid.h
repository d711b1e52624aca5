// SPDX-License-Identifier: Apache-2.0
// Quadrature and histograms over the cells of a theta-phi grid on the upper hemisphere.
#pragma once

#include "support/direction_batch.h"

#include <brdf/material.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::test {

struct HemisphereGrid {
  int n_theta = 24, n_phi = 48;
  int points = 24;  ///< of the midpoint rule, per axis of a cell

  std::size_t cells() const { return static_cast<std::size_t>(n_theta * n_phi); }
  std::size_t cell_of(const Vec3f& w) const {
    const double theta = std::atan2(std::hypot(static_cast<double>(w.x), static_cast<double>(w.y)), static_cast<double>(w.z));
    const double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * std::numbers::pi);
    const int i = std::min(static_cast<int>(theta * 2 / std::numbers::pi * n_theta), n_theta - 1);
    const int j = std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * n_phi), n_phi - 1);
    return static_cast<std::size_t>(i * n_phi + j);
  }
};

/// Integrals over one cell each.
struct CellIntegrals {
  std::vector<double> pdf, f_cos;  ///< f_cos of channel 0
};

inline CellIntegrals integrate(const Material& m, const Vec3f& wo, const HemisphereGrid& g) {
  CellIntegrals out;
  const auto n = static_cast<std::size_t>(g.points * g.points);
  DirectionBatch view(n);
  for (std::size_t k = 0; k < n; ++k) view.x[k] = wo.x, view.y[k] = wo.y, view.z[k] = wo.z;
  std::vector<float> f(n * static_cast<std::size_t>(m.channels())), pdf(n);
  std::vector<double> area(n);
  const double dt = 0.5 * std::numbers::pi / (g.n_theta * g.points), dp = 2 * std::numbers::pi / (g.n_phi * g.points);
  for (int i = 0; i < g.n_theta; ++i)
    for (int j = 0; j < g.n_phi; ++j) {
      DirectionBatch wi;
      for (int a = 0; a < g.points; ++a)
        for (int b = 0; b < g.points; ++b) {
          const double theta = (i * g.points + a + 0.5) * dt, phi = (j * g.points + b + 0.5) * dp;
          area[wi.size()] = dp * (std::cos(theta - 0.5 * dt) - std::cos(theta + 0.5 * dt));
          wi.push(direction_at(std::cos(theta), phi));
        }
      m.eval_pdf(wi.span(), view.span(), {f.data(), n}, pdf.data());
      double sum_pdf = 0, sum_f = 0;
      for (std::size_t k = 0; k < n; ++k) {
        sum_pdf += area[k] * static_cast<double>(pdf[k]);
        sum_f += area[k] * static_cast<double>(f[k] * wi.z[k]);
      }
      out.pdf.push_back(sum_pdf);
      out.f_cos.push_back(sum_f);
    }
  return out;
}

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// Integrals over the directions above the horizon, by the midpoint rule in the coordinates of sample/half_vector_map.h,
// which follow what is peaked around a half vector, and by cells of a theta-phi grid.
#pragma once

#include "sample/half_vector_map.h"
#include "support/direction_batch.h"

#include <brdf/material.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::test {

struct HemisphereGrid {
  int n_theta = 24, n_phi = 48;

  std::size_t cells() const { return static_cast<std::size_t>(n_theta * n_phi); }
  std::size_t cell_of(const Vec3f& w) const {
    const double theta = std::atan2(std::hypot(static_cast<double>(w.x), static_cast<double>(w.y)), static_cast<double>(w.z));
    const double turn = std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)) / (2 * std::numbers::pi);
    const int i = std::min(static_cast<int>(theta * 2 / std::numbers::pi * n_theta), n_theta - 1);
    const int j = std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * n_phi), n_phi - 1);
    return static_cast<std::size_t>(i * n_phi + j);
  }
};

/// Integrals over one cell each, of the density and of f cos_i, mean of the channels.
struct CellIntegrals {
  std::vector<double> pdf, f_cos;
};

/// Adds the integrals over the directions on one side (along = 1: that of the view, -1: the other one, 0: both), with
/// points around the half vectors of the view or, `turned`, of the view turned by pi.
inline void add_integrals(const Material& m, const Vec3f& wo, const HemisphereGrid& grid, bool turned, int along, CellIntegrals& out) {
  constexpr std::size_t rows = 500, columns = 700;
  const double rho = std::hypot(static_cast<double>(wo.x), static_cast<double>(wo.y)), side = turned ? -1 : 1;
  const double e_x = rho > 0 ? side * static_cast<double>(wo.x) / rho : side, e_y = rho > 0 ? side * static_cast<double>(wo.y) / rho : 0;
  const sample::HalfVectorMap<double> map(rho, static_cast<double>(wo.z));
  DirectionBatch view(2 * columns);
  for (std::size_t k = 0; k < view.size(); ++k) view.x[k] = wo.x, view.y[k] = wo.y, view.z[k] = wo.z;
  std::vector<float> f(view.size() * static_cast<std::size_t>(m.channels())), pdf(view.size());
  std::vector<double> area(view.size());
  for (std::size_t i = 0; i < rows; ++i) {
    DirectionBatch wi;
    for (std::size_t j = 0; j < columns; ++j) {
      // heights by cubes: most points where narrow lobes are
      const double t = (static_cast<double>(j) + 0.5) / columns, height = t * t * t;
      const auto h = map.half_vector(height, (static_cast<double>(i) + 0.5) / rows);
      const double x = 2 * h.wo_h * h.x - map.s;
      const bool counts = along == 0 || (side * x > 0) == (along > 0);
      for (const double mirror : {1.0, -1.0}) {
        const double y = 2 * h.wo_h * h.y * mirror;
        area[wi.size()] = counts ? h.area * 3 * t * t / (rows * columns) : 0;
        wi.push(Vec3f(Vec3d(x * e_x - y * e_y, x * e_y + y * e_x, 2 * h.wo_h * h.z - map.c)));
      }
    }
    m.eval_pdf(wi.span(), view.span(), {f.data(), view.size()}, pdf.data());
    for (std::size_t k = 0; k < view.size(); ++k) {
      const std::size_t cell = grid.cell_of(wi[k]);
      out.pdf[cell] += area[k] * static_cast<double>(pdf[k]);
      double sum = 0;
      for (std::size_t c = k; c < f.size(); c += view.size()) sum += static_cast<double>(f[c]);
      out.f_cos[cell] += area[k] * sum / static_cast<double>(m.channels()) * static_cast<double>(wi.z[k]);
    }
  }
}

inline CellIntegrals integrate(const Material& m, const Vec3f& wo, const HemisphereGrid& grid, bool has_retro_lobes) {
  CellIntegrals out{std::vector<double>(grid.cells()), std::vector<double>(grid.cells())};
  if (has_retro_lobes) {
    add_integrals(m, wo, grid, false, -1, out);
    add_integrals(m, wo, grid, true, 1, out);
  } else {
    add_integrals(m, wo, grid, false, 0, out);
  }
  return out;
}

}  // namespace brdf::test

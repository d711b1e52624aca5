// SPDX-License-Identifier: Apache-2.0
#include "eval/reference.h"

#include "geometry/half_difference.h"
#include "residual/grid_coordinates.h"
#include "residual/half_float.h"

#include <algorithm>
#include <cmath>

namespace brdf::eval {

namespace {

struct Node {
  int below, above;
  double fraction;
};

Node node_of(double u, int n) noexcept {
  const double x = std::clamp(u, 0.0, 1.0) * (n - 1);
  const int i = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(n - 2, 0));
  return {i, std::min(i + 1, n - 1), x - i};
}

}  // namespace

GridCoordinates grid_coordinates(const residual::ResidualGrid& grid, const Vec3d& wi, const Vec3d& wo) noexcept {
  const auto hd = geometry::half_difference<double>(wi, wo);
  GridCoordinates u;
  u.u_h = residual::warp(residual::chord(hd.sin_theta_h, hd.cos_theta_h), static_cast<double>(grid.kappa_h));
  u.u_d = residual::warp(residual::chord(hd.sin_theta_d, hd.cos_theta_d), static_cast<double>(grid.kappa_d));
  const double cross = (wi.x + wo.x) * (wi.y - wo.y) - (wi.y + wo.y) * (wi.x - wo.x);  // has the sign of sin phi_d
  switch (grid.azimuth) {
    case residual::Azimuth::one_way: u.u_p = residual::phi_coordinate(hd.cos_phi_d); break;
    case residual::Azimuth::symmetric: u.u_p = 2 * residual::phi_coordinate(std::fabs(hd.cos_phi_d)); break;
    case residual::Azimuth::reciprocal: u.u_p = residual::phi_coordinate(cross < 0 ? -hd.cos_phi_d : hd.cos_phi_d); break;
  }
  return u;
}

double ratio_at(const residual::ResidualGrid& grid, const GridCoordinates& u, int c) noexcept {
  const Node h = node_of(u.u_h, grid.n_h), d = node_of(u.u_d, grid.n_d), p = node_of(u.u_p, grid.n_p);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const bool up_h = corner & 4, up_d = corner & 2, up_p = corner & 1;
    const double weight = (up_h ? h.fraction : 1 - h.fraction) * (up_d ? d.fraction : 1 - d.fraction) *
                          (up_p ? p.fraction : 1 - p.fraction);
    const auto i_h = static_cast<std::size_t>(up_h ? h.above : h.below);
    const auto i_d = static_cast<std::size_t>(up_d ? d.above : d.below);
    const auto i_p = static_cast<std::size_t>(up_p ? p.above : p.below);
    const auto n_d = static_cast<std::size_t>(grid.n_d), n_p = static_cast<std::size_t>(grid.n_p);
    const std::size_t node = i_p + n_p * (i_d + n_d * i_h);
    const auto at = node * static_cast<std::size_t>(grid.channels) + static_cast<std::size_t>(c);
    sum += weight * static_cast<double>(residual::float_from_half(grid.ratio[at]));
  }
  return sum;
}

void eval_reference(const LobeSet& lobes, const residual::ResidualGrid& grid, const Vec3d& wi, const Vec3d& wo,
                    std::span<double> f) noexcept {
  eval_lobes(lobes, wi, wo, f);
  if (grid.empty() || !(wi.z > 0) || !(wo.z > 0)) return;
  const GridCoordinates u = grid_coordinates(grid, wi, wo);
  const double epsilon = grid.epsilon;
  for (std::size_t c = 0; c < f.size(); ++c)
    f[c] = std::max(0.0, (f[c] + epsilon) * ratio_at(grid, u, static_cast<int>(c)) - epsilon);
}

}  // namespace brdf::eval

// SPDX-License-Identifier: Apache-2.0
// The table that evaluation reads: measurement over lobes, as half floats.
#pragma once

#include "residual/azimuth.h"

#include <cstdint>
#include <vector>

namespace brdf::residual {

/// Ratio R = (f + epsilon) / (lobes + epsilon) on nodes over the unit cube (u_h, u_d, u_p), so
///   f_c = max(0, (lobes_c + epsilon) R_c - epsilon),   R trilinear between nodes.
/// u_h = warp(chord(theta_h), kappa_h), u_d = warp(chord(theta_d), kappa_d); node i of n sits at i / (n - 1).
/// u_p = phi_coordinate(cos_phi_d). Symmetric: u_p = 2 phi_coordinate(|cos_phi_d|); reciprocal: phi_coordinate of cos_phi_d
/// with the sign of sin phi_d, that is of phi_d modulo pi. In both, exchange of the directions gives the same bits. Node index = p + n_p * (d + n_d * h); `channels` adjacent halves per node.
/// `ratio` is padded by at least 8 finite halves, so that kernels may read whole vectors past the last node.
struct ResidualGrid {
  int n_h = 0, n_d = 0, n_p = 0, channels = 0;
  Azimuth azimuth = Azimuth::one_way;
  float kappa_h = 1, kappa_d = 1;
  float epsilon = 0;
  std::vector<std::uint16_t> ratio;  ///< IEEE binary16, positive and normal
  bool empty() const noexcept { return ratio.empty(); }
};

}  // namespace brdf::residual

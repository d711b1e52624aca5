// SPDX-License-Identifier: Apache-2.0
// The measurement averaged over cells of the residual's own coordinates: the data term of the encoder.
#pragma once

#include "residual/basis.h"

#include <brdf/lobes.h>
#include <brdf/measurement.h>

#include <cstdint>
#include <vector>

namespace brdf::encode {

/// A grid of n_h x n_d x n_p cells over (u_h, u_d, phi_d in [0, pi]); cell index = p + n_p * (d + n_d * h). Along u a
/// cell's coordinate is its middle.
struct Bins {
  int n_h = 0, n_d = 0, n_p = 0, channels = 0;
  std::vector<double> u_h, u_d, cos_phi;              ///< middles along each axis
  std::vector<double> sin_h, cos_h, sin_d, cos_d;     ///< of the middles of the u axes
  std::vector<double> d_theta_h, d_theta_d;           ///< widths of the cells, radians
  std::vector<double> cos_i, cos_o;                   ///< of each cell's middle; at most 0 below the horizon
  std::vector<std::uint8_t> valid;                    ///< something was measured there
  std::vector<double> f;                              ///< mean f, cell-major
  std::vector<double> y;                              ///< mean log((f + epsilon) / (lobes + epsilon)), cell-major
  std::size_t cells() const noexcept { return cos_i.size(); }
};

/// Samples a measurement at substeps^3 places of every cell, evenly spread, and averages: noise and detail finer than a
/// cell average out, and the mean belongs to the middle.
Bins sample_bins(const Measurement& m, const LobeSet& lobes, const residual::Basis& basis, int n_h, int n_d, int n_p,
                 int substeps = 1);

}  // namespace brdf::encode

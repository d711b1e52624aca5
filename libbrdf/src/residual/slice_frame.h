// SPDX-License-Identifier: Apache-2.0
// Coordinates of a measurement that was taken in slices: for each theta_i of a list, a square over the visible normals of
// that direction, after Dupuy and Jakob 2018 (An Adaptive Parameterization for Efficient Material Acquisition and
// Rendering). Written in these coordinates such a measurement needs as few numbers as the instrument recorded.
#pragma once

#include "residual/coefficient_order.h"

#include <cstdint>
#include <vector>

namespace brdf::residual {

/// As stored. Empty for a residual in half/difference coordinates.
struct SliceFrame {
  std::vector<std::uint16_t> theta_i;  ///< nodes in pi/2 / 65535, ascending; at most max_m
  std::uint8_t width = 0;              ///< nodes along the elevation of the normal, 2 to max_k
  std::uint8_t height = 0;             ///< nodes around the full circle of azimuth, 2 to 2 max_l; mirrored halves are one
  std::uint8_t rows = 0;               ///< azimuths at which the density of the normals is known, at least 4
  std::uint8_t ndf_step = 0;           ///< codes of the ndf are in units of 2^-(ndf_step / 2) octaves
  std::vector<std::int16_t> ndf;       ///< log2 of the ndf at nodes along u = sqrt(2 theta_h / pi), 3 to 255
  std::uint8_t epsilon = 0;            ///< epsilon_of: what is added to a value of the table before its logarithm
  bool empty() const noexcept { return theta_i.empty(); }
  int half_height() const noexcept { return (height + 1) / 2; }
};

inline constexpr int max_ndf_step = 20;

/// Frequencies that a frame can hold.
inline Extent reach_of(const SliceFrame& f) noexcept {
  if (f.empty()) return {max_k, max_l, max_m};
  return {f.width, f.half_height(), static_cast<int>(f.theta_i.size())};
}

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
// A residual in slice coordinates as a table of what the instrument saw.
#pragma once

#include "residual/reconstruct.h"
#include "slices/slice_map.h"

#include <span>
#include <vector>

namespace brdf::slices {

class SliceTable {
 public:
  /// Evaluates the cosines of `c`, which has a frame, at the nodes.
  explicit SliceTable(const residual::Coefficients& c);

  /// f in 1/sr, one value per channel, of a pair of unit vectors above the horizon: bilinear in the square, linear
  /// between slices, times the jacobian of the map (Dupuy and Jakob 2018, eq. 9).
  void eval(const SliceAngles& at, double cos_o, std::span<float> f) const noexcept;

 private:
  SliceMap map_;
  std::size_t width_, half_height_, height_, channels_;
  std::vector<float> values_;  ///< [slice][v][u][channel], not negative
};

}  // namespace brdf::slices

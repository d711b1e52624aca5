// SPDX-License-Identifier: Apache-2.0
// A residual in slice coordinates as a table of what the instrument saw.
#pragma once

#include "residual/reconstruct.h"
#include "slices/slice_map.h"

#include <span>
#include <vector>

namespace brdf::slices {

/// No f is larger, as with lobes: a file may ask for products beyond float, and quotients with densities must stay finite.
inline constexpr float largest_value = 1e30f;

/// The numbers of a table for kernels that read them in vectors.
struct SliceView {
  const float* theta_i = nullptr;    ///< nodes, `slices` of them
  const float* per_radian = nullptr; ///< 1 / (distance of a node to the next)
  const float* density = nullptr;    ///< [slice][row][column][2]: density of the normals and its integral along the row
  const float* row = nullptr;        ///< [slice][row][2]: total, and integral up to there
  const float* ndf = nullptr;        ///< [column]
  const float* sigma = nullptr;      ///< [node]
  const float* values = nullptr;     ///< [slice][v][u][channel], eight floats of padding
  int slices = 0, columns = 0, rows = 0, all_rows = 0, sigma_nodes = 0, width = 0, height = 0, half_height = 0, channels = 0;
};

class SliceTable {
 public:
  /// Evaluates the cosines of `c`, which has a frame, at the nodes.
  explicit SliceTable(const residual::Coefficients& c);

  /// f in 1/sr, one value per channel, of a pair of unit vectors above the horizon: bilinear in the square, linear
  /// between slices, times the jacobian of the map (Dupuy and Jakob 2018, eq. 9).
  void eval(const SliceAngles& at, double cos_o, std::span<float> f) const noexcept;

  SliceView view() const noexcept;
  std::size_t bytes() const noexcept;

  /// bytes() of the table of a frame, before it is made.
  static std::size_t bytes_of(const residual::SliceFrame& frame, int channels) noexcept;
  /// What making it takes at most beside that.
  static std::size_t temporary_bytes_of(const residual::SliceFrame& frame, int channels) noexcept;

 private:
  SliceMap map_;
  std::size_t width_, half_height_, height_, channels_;
  std::vector<float> values_;  ///< [slice][v][u][channel], not negative; padded
  std::vector<float> theta_i_, per_radian_;
};

}  // namespace brdf::slices

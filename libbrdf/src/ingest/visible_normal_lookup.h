// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/measurement.h>

#include "ingest/bilinear_density.h"

#include <span>
#include <vector>

namespace brdf::ingest {

/// Whether a table that runs along elevation in its rows says the same for every azimuth.
bool rows_are_equal(const std::vector<float>& table, std::size_t width);

/// Interpolated value of an RGL table (Dupuy and Jakob 2018, section 5). Keeps a reference to the table.
class VisibleNormalLookup {
 public:
  /// Throws Error(invalid_argument) when the sizes of `table` contradict each other.
  VisibleNormalLookup(const VisibleNormalTable& table, int channels);

  /// As MeasurementInterpolator::eval.
  bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept;

  /// f cos theta_o as stored: not clipped at 0, and wo may be below the horizon, where tables hold what interpolation
  /// towards the horizon needs. `half` is the half vector in the coordinates of the table: sqrt(2 theta_h / pi) and
  /// (phi_h - phi_i + pi) / 2 pi.
  void reflected(double theta_i, SquarePoint half, std::span<double> f_cos) const noexcept;

 private:
  void stored(const SliceBlend& blend, SquarePoint half, std::span<double> values) const noexcept;
  SliceBlend elevation_blend(double theta_i) const noexcept;
  double jacobian(double u_i, const Vec3d& wi, SquarePoint half) const noexcept;

  const VisibleNormalTable& table_;
  std::size_t channels_;
  BilinearDensity visible_normals_;
  bool sigma_is_isotropic_;  ///< every row of sigma is the same: the azimuth of wi is not needed
};

}  // namespace brdf::ingest

// SPDX-License-Identifier: Apache-2.0
// From directions to the squares of a SliceFrame, after Dupuy and Jakob 2018, sections 4 and 5. Everything is derived
// from the ndf: the density of visible normals D(m) max(0, m . wi) of each slice, its cumulative map, and the projected
// area of the microsurface. Azimuths are folded: phi_h - phi_i and its negative are one.
#pragma once

#include "residual/slice_frame.h"

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::slices {

/// A pair of directions in the terms of a frame.
struct SlicePoint {
  std::size_t slice = 0;   ///< the lower of two neighbouring slices
  float fraction = 0;      ///< towards the upper one
  float u = 0, v = 0;      ///< in the unit square: along the elevation of the normal, around its azimuth (0 to 1/2)
  float scale = 0;         ///< f = scale times what the table holds: ndf / (4 sigma cos theta_o)
};

/// Elevation and azimuth of a pair, in the units of a frame.
struct SliceAngles {
  double theta_i = 0;  ///< radians
  double u_h = 0;      ///< sqrt(2 theta_h / pi)
  double v_h = 0;      ///< (pi - |phi_h - phi_i|) / 2 pi: 0 across the normal from wi, 1/2 on its side
};

class SliceMap {
 public:
  /// The frame must be valid (container::is_valid). About 0.3 ms and 0.6 MB for 8 slices of 64 x 128.
  explicit SliceMap(const residual::SliceFrame& frame);

  SlicePoint point(const SliceAngles& at, double cos_o) const noexcept;

  /// Inverse at the nodes: angles that the map takes to (u, v) of a slice. Where the density is 0 the map is flat, and
  /// the smallest elevation is returned.
  SliceAngles angles(std::size_t slice, double u, double v) const noexcept;

  /// Density of the normals at an azimuth of a slice; 0 where none can be seen.
  double row_density(std::size_t slice, double v) const noexcept;

  /// ndf / (4 sigma).
  double jacobian(const SliceAngles& at) const noexcept;

  std::size_t slices() const noexcept { return theta_i_.size(); }
  std::size_t columns() const noexcept { return columns_; }
  std::size_t rows() const noexcept { return rows_; }
  std::size_t all_rows() const noexcept { return all_rows_; }
  double theta_i(std::size_t slice) const noexcept { return theta_i_[slice]; }
  std::span<const float> ndf() const noexcept { return ndf_; }
  std::span<const float> sigma() const noexcept { return sigma_; }

  /// Density at a sample and its integral along the row up to there, in cells.
  struct Sample {
    float density, before;
  };
  /// Integral of a row, and of those before it.
  struct Row {
    float total, before;
  };
  std::span<const Sample> samples() const noexcept { return samples_; }  ///< [slice][row][column]
  std::span<const Row> row_integrals() const noexcept { return row_; }   ///< [slice][row]

 private:
  struct RowPosition {
    std::size_t row;
    double fraction, beyond;  ///< towards the next row; beyond the last one, in cells
  };
  RowPosition row_at(std::size_t slice, double v) const noexcept;

  struct Cell {
    std::size_t left;
    float fraction;
  };
  static Cell cell(double x, std::size_t count) noexcept;
  void build_slice(std::size_t slice);
  void build_sigma();
  const Sample* samples(std::size_t slice, std::size_t row) const noexcept { return samples_.data() + (slice * rows_ + row) * columns_; }

  std::vector<double> theta_i_;
  std::vector<float> ndf_;    ///< linear in u between nodes
  std::vector<float> sigma_;  ///< at nodes over u_i = sqrt(2 theta_i / pi)
  std::size_t columns_, rows_, all_rows_;  ///< rows_: folded; all_rows_: of the full circle
  std::vector<Sample> samples_;            ///< [slice][row][column]
  std::vector<Row> row_;                   ///< [slice][row]
};

/// Nodes of sigma over u_i.
inline constexpr std::size_t sigma_nodes = 129;

/// Angles of a pair of unit vectors above the horizon.
SliceAngles slice_angles(double ix, double iy, double iz, double ox, double oy, double oz) noexcept;

/// Value of the ndf that a code stands for.
double ndf_of(int code, int step) noexcept;

}  // namespace brdf::slices

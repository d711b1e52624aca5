// SPDX-License-Identifier: Apache-2.0
// Densities on the unit square that are bilinear between samples, and the map that makes them uniform.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace brdf::ingest {

/// A slice of a stack of tables and its share in a linear blend.
struct WeightedSlice {
  std::size_t slice;
  double weight;
};

/// Two neighbouring slices; the weights add up to 1.
using SliceBlend = std::array<WeightedSlice, 2>;

struct SquarePoint {
  double u, v;  ///< u along the width of the tables, v along the height
};

/// A stack of bilinear densities, each normalised to 1. Between slices both the densities and their cumulative sums
/// are blended linearly (Dupuy and Jakob 2018, section 5.2).
class BilinearDensity {
 public:
  /// `tables` holds slices of height rows of width samples, at least 2 each, values at least 0. A slice of zeros is
  /// allowed and maps everything to the origin.
  BilinearDensity(const std::vector<float>& tables, std::size_t height, std::size_t width);

  /// Cumulative map of the blended density: over rows first (v), then within the interpolated row (u). It undoes the
  /// sampling of the density, so that points drawn from it come out uniform on the unit square.
  SquarePoint to_uniform(SquarePoint p, const SliceBlend& blend) const noexcept;

 private:
  struct Sample {
    double density;
    double before;  ///< integral along the row up to this sample, in units of one cell
  };
  struct Row {
    double total;   ///< integral along the row
    double before;  ///< integral over the rows up to this one
  };

  std::size_t height_, width_;
  std::vector<Sample> samples_;  ///< [slice][row][column]; one cache line serves both numbers of two neighbours
  std::vector<Row> rows_;        ///< [slice][row]
};

}  // namespace brdf::ingest

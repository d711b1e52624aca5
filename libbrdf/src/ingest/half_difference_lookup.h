// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/measurement.h>

#include <cstddef>
#include <span>

namespace brdf::ingest {

/// Interpolated value of a table in half/difference angles: linear in bin coordinates (so in sqrt(theta_h)), phi_d
/// wraps around, the other axes are clamped. Corners without a measurement are left out and the weights of the others
/// renormalised. Keeps a reference to the table.
class HalfDifferenceLookup {
 public:
  /// Throws Error(invalid_argument) when the sizes of `table` contradict each other.
  HalfDifferenceLookup(const HalfDifferenceTable& table, int channels);

  /// As MeasurementInterpolator::eval. A table of half a circle answers exactly the same for exchanged directions.
  bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept;

 private:
  const HalfDifferenceTable& table_;
  std::size_t channels_;
  double offset_;  ///< of a sample within its bin
};

}  // namespace brdf::ingest

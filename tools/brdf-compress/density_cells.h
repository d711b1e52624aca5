// SPDX-License-Identifier: Apache-2.0
// A density over the hemisphere, integrated in cells that follow it.
#pragma once

#include <brdf/material.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brdf::cli {

/// Cells in theta and phi, split in four until 4 x 4 Gauss points agree with the four parts; also split where samples
/// gather, so that no lobe is too narrow to be noticed.
class DensityCells {
 public:
  /// The density of `material` for `wo`, and the samples drawn from it (those with pdf 0 left out).
  DensityCells(const Material& material, const Vec3f& wo, std::span<const Vec3f> samples);

  double integral() const noexcept { return integral_; }
  /// Integral of the mean of the channels of f cos theta_i.
  double f_cos() const noexcept { return f_cos_; }
  /// Integral of the density, and number of samples, of each cell; neighbours stand near each other.
  const std::vector<double>& mass() const noexcept { return mass_; }
  const std::vector<double>& count() const noexcept { return count_; }

 private:
  std::vector<double> mass_, count_;
  double integral_ = 0, f_cos_ = 0;
};

}  // namespace brdf::cli

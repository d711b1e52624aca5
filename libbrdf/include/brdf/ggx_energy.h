// SPDX-License-Identifier: Apache-2.0
/// @file ggx_energy.h
/// What one bounce on a white GGX surface returns, and the term that adds what further bounces would.
#pragma once

#include <array>
#include <cstddef>

namespace brdf {

/// Energy of the GGX lobe of one roughness with F = 1, and its compensation after Kulla and Conty 2017 (Revisiting
/// Physically Based Shading at Imageworks). The lobes of the format have no such term: what a rough lobe loses there is
/// part of what was fitted. It is for materials that are given by formulas.
///
/// Losses are tabulated over the cosine by quadrature over the visible normals: within 3e-4 (absolute). Immutable after
/// construction and thread-safe.
class GgxEnergy {
 public:
  /// Takes some ten milliseconds. alpha from 1e-5 to 1; else throws Error(invalid_argument).
  explicit GgxEnergy(double alpha);

  /// Directional albedo E: the integral of f cos_i over the hemisphere of wi, for a direction of cosine `cos_theta` in
  /// [0, 1]. 1 minus the loss.
  double albedo(double cos_theta) const noexcept { return 1 - loss(cos_theta); }
  double loss(double cos_theta) const noexcept;

  /// 2 times the integral of E cos over cos from 0 to 1: what is returned of uniform light. 1 minus the mean loss.
  double mean_albedo() const noexcept { return 1 - mean_loss_; }
  double mean_loss() const noexcept { return mean_loss_; }

  /// f in 1/sr, without the cosine, to be added to the lobe so that a white surface returns all light. Symmetric to the
  /// last bit; 0 with either cosine not above 0.
  double compensation(double cos_i, double cos_o) const noexcept;

  /// Factor of `compensation` for a surface of mean reflectance F (see schlick_mean), which absorbs a part at every bounce:
  /// F^2 E / (1 - F (1 - E)) with the mean albedo E. 1 for F = 1.
  double compensation_color(double mean_fresnel) const noexcept;

 private:
  static constexpr std::size_t nodes = 97;
  std::array<double, nodes> loss_{};
  double alpha_, range_, mean_loss_ = 0;
};

/// Cosine-weighted mean of Schlick's f0 + (f90 - f0) (1 - cos theta)^5 over the hemisphere: (20 f0 + f90) / 21.
constexpr double schlick_mean(double f0, double f90) noexcept { return (20 * f0 + f90) / 21; }

}  // namespace brdf

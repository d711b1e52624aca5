// SPDX-License-Identifier: Apache-2.0
// Derivatives of lobe values with respect to lobe parameters.
#pragma once

#include "lobes/lobe_geometry.h"

#include <brdf/lobes.h>

#include <span>

namespace brdf::lobes {

/// ggx_shape and its derivative by alpha.
struct ShapeDerivative {
  double value = 0;
  double d_alpha = 0;
};

ShapeDerivative ggx_shape_derivative(const LobeGeometry& g, double alpha) noexcept;

/// Value of one lobe and its partial derivatives, per channel (spans of lobe.color.size() values). The value of a
/// channel depends on no other channel's colour, so `d_color` is the diagonal. All 0 at or below the horizon; the
/// derivatives by alpha and f90 are 0 for Lambert.
struct LobeJacobian {
  std::span<double> value, d_alpha, d_f90, d_color;
};

void lobe_jacobian(const Lobe& lobe, const Vec3d& wi, const Vec3d& wo, const LobeJacobian& out) noexcept;

}  // namespace brdf::lobes

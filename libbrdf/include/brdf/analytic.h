// SPDX-License-Identifier: Apache-2.0
/// @file analytic.h
/// Materials that a formula describes, beside those that were measured: Material::from_analytic takes one.
#pragma once

#include <variant>
#include <vector>

namespace brdf {

/// The perfect diffuser, f = albedo / pi.
struct Lambert {
  std::vector<float> albedo;  ///< one per channel, 0 to 1
};

/// Glossy reflection by microfacets: the GGX distribution, height-correlated Smith masking-shadowing and Schlick's Fresnel
/// with f90 = 1. With h the half vector, theta_d half the angle between the directions and c = wi.z, wo.z,
///   f = F D G2 / (4 c_i c_o),  D = 1 / (pi a_x a_y ((h_x / a_x)^2 + (h_y / a_y)^2 + h_z^2)^2)   (Heitz 2014, eq. 85)
///   G2 = 1 / (1 + Lambda(wi) + Lambda(wo)),  Lambda = (sqrt(1 + (a_x^2 w_x^2 + a_y^2 w_y^2) / w_z^2) - 1) / 2   (eq. 99, 86)
///   F = f0 + (1 - f0) (1 - cos theta_d)^5                                                       (Schlick 1994, eq. 24)
struct GgxReflector {
  float alpha_x = 0.1f;  ///< roughness along the tangent, 1e-4 to 1
  float alpha_y = 0.1f;  ///< and across it; anisotropic where the two differ
  std::vector<float> f0;  ///< reflectance at normal incidence, one per channel, 0 to 1
  /// Adds what further bounces between the facets return (Kulla and Conty 2017; see GgxEnergy). Isotropic only.
  bool multiple_scattering = false;
};

/// The ideal mirror: a delta lobe.
struct Mirror {
  std::vector<float> reflectance;  ///< one per channel, 0 to 1
};

/// A smooth interface between two clear media: delta reflection and delta transmission, shared out by Fresnel's equations
/// for unpolarised light, with total internal reflection. Seen from both sides: wo.z < 0 is inside, below the surface.
struct Dielectric {
  float ior = 1.5f;  ///< index of refraction below the surface over that above it, 0.1 to 10
  int channels = 3;  ///< 1 to 1024
};

using AnalyticModel = std::variant<Lambert, GgxReflector, Mirror, Dielectric>;

/// "lambert", "ggx", "mirror" or "dielectric".
const char* name_of(const AnalyticModel& model) noexcept;

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// Surfaces that the simulated instrument can look at: a rough interface over a coloured diffuse base, with retro-reflecting
// beads in it or fibres on it where the recipe says so.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace brdf::gonio {

/// Plain description of a surface.
struct SurfaceRecipe {
  std::string_view name, description;
  double alpha;                           ///< GGX roughness of the interface
  double haze_alpha, haze_share;          ///< share of the area that is rougher
  std::array<double, 3> ior, extinction;  ///< complex index of refraction for red, green, blue; k = 0: dielectric
  std::array<double, 3> base;             ///< reflectance of the base below the interface
  double noise = 0.03;                    ///< of its measurement, relative standard deviation at normal incidence
  double retro_alpha = 0.1, retro_share = 0;  ///< share of the area that sends light back where it came from, and its roughness
  std::array<double, 3> retro_colour{0, 0, 0};
  double fibre_alpha = 0.3;               ///< how upright fibres on the surface stand
  std::array<double, 3> fibre_colour{0, 0, 0};
};

/// The named surfaces; the first is the default.
std::span<const SurfaceRecipe> surface_recipes() noexcept;

/// Reflectance of a smooth interface for unpolarised light, exact for dielectrics and conductors.
double fresnel(double cosine, double ior, double extinction) noexcept;

/// f in 1/sr. Reciprocal, mirror-symmetric, and reflects less than it receives.
class LayeredSurface {
 public:
  explicit LayeredSurface(const SurfaceRecipe& recipe) noexcept;

  /// Both directions above the horizon.
  std::array<double, 3> eval(const glm::dvec3& wi, const glm::dvec3& wo) const noexcept;

 private:
  SurfaceRecipe recipe_;
  std::array<double, 3> base_{};  ///< diffuse value with the light trapped between base and interface, 1/sr
};

}  // namespace brdf::gonio

// SPDX-License-Identifier: Apache-2.0
#include "layered_surface.h"

#include "geometry/half_difference.h"

#include <cmath>
#include <numbers>

namespace brdf::gonio {
namespace {

constexpr std::array<double, 3> glass{1.5, 1.5, 1.5}, clear{0, 0, 0}, no_base{0, 0, 0};

constexpr std::array<SurfaceRecipe, 8> recipes{{
    {"lacquer", "clear coat with a little haze over a red base", 0.07, 0.25, 0.2, glass, clear, {0.62, 0.09, 0.05}},
    {"matte", "rough clear coat over a warm grey base", 0.45, 0.8, 0.3, glass, clear, {0.58, 0.52, 0.44}},
    {"metal", "satin copper without a coat", 0.18, 0.4, 0.15, {0.200, 0.924, 1.102}, {3.912, 2.452, 2.142}, no_base},
    {"plaster", "white, nearly diffuse, hardly any gloss", 0.9, 1, 0.3, {1.2, 1.2, 1.2}, clear, {0.86, 0.85, 0.82}},
    {"satin", "blue paint of middling gloss", 0.25, 0.5, 0.3, glass, clear, {0.05, 0.16, 0.5}},
    {.name = "felt",
     .description = "green fibres that glow at grazing angles",
     .alpha = 0.8,
     .haze_alpha = 1,
     .haze_share = 0.5,
     .ior = {1.2, 1.2, 1.2},
     .extinction = clear,
     .base = {0.09, 0.24, 0.1},
     .fibre_alpha = 0.25,
     .fibre_colour = {0.16, 0.3, 0.14}},
    {.name = "reflector",
     .description = "grey tape with glass beads, which sends light back to the lamp",
     .alpha = 0.3,
     .haze_alpha = 0.6,
     .haze_share = 0.4,
     .ior = glass,
     .extinction = clear,
     .base = {0.2, 0.2, 0.21},
     .retro_alpha = 0.12,
     .retro_share = 0.35,
     .retro_colour = {0.8, 0.82, 0.85}},
    {.name = "grit",
     .description = "coarse dark grit, measured badly: noise of a quarter of the signal",
     .alpha = 0.5,
     .haze_alpha = 0.9,
     .haze_share = 0.4,
     .ior = {1.6, 1.6, 1.6},
     .extinction = clear,
     .base = {0.16, 0.13, 0.1},
     .noise = 0.25},
}};

/// D G2 / (4 cos_i cos_o): GGX (Walter et al. 2007, eq. 33), Smith height-correlated shadowing (Heitz 2014, eq. 99).
double microfacets(double sin_h, double cos_h, double cos_i, double cos_o, double alpha) noexcept {
  const double a2 = alpha * alpha;
  const double spread = sin_h * sin_h + a2 * cos_h * cos_h;
  const double d = a2 / (std::numbers::pi * spread * spread);
  const auto slope = [a2](double c) { return std::sqrt(c * c + a2 * (1 - c * c)); };
  return d / (2 * (slope(cos_i) * cos_o + slope(cos_o) * cos_i));
}

/// Hemispherical mean of the reflectance seen from outside, 2 integral F(c) c dc.
double mean_fresnel(double ior, double extinction) noexcept {
  constexpr int steps = 512;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double c = (i + 0.5) / steps;
    sum += 2 * fresnel(c, ior, extinction) * c / steps;
  }
  return sum;
}

}  // namespace

std::span<const SurfaceRecipe> surface_recipes() noexcept { return recipes; }

double fresnel(double cosine, double ior, double extinction) noexcept {
  // Born and Wolf, Principles of Optics, section 14.2 (conductors): a and b are real and imaginary part of the cosine
  // inside, times the index; extinction 0 gives the dielectric formula.
  const double c = std::fmin(std::fmax(cosine, 0.0), 1.0), c2 = c * c, s2 = 1 - c2;
  const double t = ior * ior - extinction * extinction - s2;
  const double ab = std::sqrt(t * t + 4 * ior * ior * extinction * extinction);
  const double a2 = std::fmax(0.5 * (ab + t), 0.0), a = std::sqrt(a2);
  const double rs = (ab + c2 - 2 * a * c) / (ab + c2 + 2 * a * c);
  const double rp = rs * (c2 * ab + s2 * s2 - 2 * a * c * s2) / (c2 * ab + s2 * s2 + 2 * a * c * s2);
  return 0.5 * (rs + rp);
}

LayeredSurface::LayeredSurface(const SurfaceRecipe& recipe) noexcept : recipe_(recipe) {
  for (std::size_t c = 0; c < base_.size(); ++c) {
    if (recipe.base[c] == 0) continue;
    // Light leaves the base diffusely; 1 - (1 - mean F) / n^2 of it is sent back by the interface, again and again.
    const double n2 = recipe.ior[c] * recipe.ior[c];
    const double inside = 1 - (1 - mean_fresnel(recipe.ior[c], recipe.extinction[c])) / n2;
    base_[c] = recipe.base[c] / (std::numbers::pi * n2 * (1 - recipe.base[c] * inside));
  }
}

std::array<double, 3> LayeredSurface::eval(const glm::dvec3& wi, const glm::dvec3& wo) const noexcept {
  const auto g = geometry::half_difference(wi, wo);
  const double gloss = (1 - recipe_.haze_share) * microfacets(g.sin_theta_h, g.cos_theta_h, wi.z, wo.z, recipe_.alpha) +
                       recipe_.haze_share * microfacets(g.sin_theta_h, g.cos_theta_h, wi.z, wo.z, recipe_.haze_alpha);
  double retro = 0, fibres = 0;
  if (recipe_.retro_share > 0) {  // the same microfacets, seen by a viewer who stands opposite
    const auto r = geometry::half_difference(wi, glm::dvec3(-wo.x, -wo.y, wo.z));
    retro = recipe_.retro_share * microfacets(r.sin_theta_h, r.cos_theta_h, wi.z, wo.z, recipe_.retro_alpha);
  }
  if (recipe_.fibre_colour != std::array<double, 3>{}) {
    // Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", eq. 2, with the visibility of Neubelt and Pettineo 2013
    const double d = (2 + 1 / recipe_.fibre_alpha) * std::pow(g.sin_theta_h, 1 / recipe_.fibre_alpha) / (2 * std::numbers::pi);
    fibres = d / (4 * (wi.z + wo.z - wi.z * wo.z));
  }
  std::array<double, 3> f{};
  for (std::size_t c = 0; c < f.size(); ++c) {
    const double n = recipe_.ior[c], k = recipe_.extinction[c];
    f[c] = (1 - recipe_.retro_share) * fresnel(g.cos_theta_d, n, k) * gloss + recipe_.retro_colour[c] * retro + recipe_.fibre_colour[c] * fibres;
    if (base_[c] > 0) f[c] += (1 - recipe_.retro_share) * base_[c] * (1 - fresnel(wi.z, n, k)) * (1 - fresnel(wo.z, n, k));
  }
  return f;
}

}  // namespace brdf::gonio

// SPDX-License-Identifier: Apache-2.0
#include "layered_surface.h"

#include "geometry/half_difference.h"

#include <cmath>
#include <numbers>

namespace brdf::gonio {
namespace {

constexpr std::array<SurfaceRecipe, 3> recipes{{
    {"lacquer",
     "clear coat with a little haze over a red base",
     0.07,
     0.25,
     0.2,
     {1.5, 1.5, 1.5},
     {0, 0, 0},
     {0.62, 0.09, 0.05}},
    {"matte", "rough clear coat over a warm grey base", 0.45, 0.8, 0.3, {1.5, 1.5, 1.5}, {0, 0, 0}, {0.58, 0.52, 0.44}},
    {"metal", "satin copper without a coat", 0.18, 0.4, 0.15, {0.200, 0.924, 1.102}, {3.912, 2.452, 2.142}, {0, 0, 0}},
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
  std::array<double, 3> f{};
  for (std::size_t c = 0; c < f.size(); ++c) {
    const double n = recipe_.ior[c], k = recipe_.extinction[c];
    f[c] = fresnel(g.cos_theta_d, n, k) * gloss;
    if (base_[c] > 0) f[c] += base_[c] * (1 - fresnel(wi.z, n, k)) * (1 - fresnel(wo.z, n, k));
  }
  return f;
}

}  // namespace brdf::gonio

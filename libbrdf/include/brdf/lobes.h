// SPDX-License-Identifier: Apache-2.0
/// @file lobes.h
/// Analytic lobes and their sum.
#pragma once

#include <brdf/direction.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brdf {

/// Identifiers are part of the file format and never change meaning.
enum class LobeKind : std::uint8_t {
  lambert = 0,    ///< f = rho / pi
  ggx = 1,        ///< microfacet reflection, GGX ndf, Smith height-correlated masking-shadowing, Schlick Fresnel
  retro_ggx = 2,  ///< the same around the back direction: evaluated with wo turned by pi about the normal
};

/// One lobe. For GGX kinds
///   f_c = F_c(theta_d) D(theta_h) G2(wi, wo) / (4 cos_i cos_o),
///   D = alpha^2 / (pi (cos^2 theta_h (alpha^2 - 1) + 1)^2)            (Walter et al. 2007, eq. 33)
///   G2 = 1 / (1 + Lambda(wi) + Lambda(wo))                            (Heitz 2014, eq. 99 with eq. 72)
///   F_c = f0_c + (f90 - f0_c) (1 - cos theta_d)^5                     (Schlick 1994, eq. 24, with a free f90)
struct Lobe {
  LobeKind kind = LobeKind::lambert;
  double alpha = 1;           ///< GGX roughness, 1e-5 to 1; unused for Lambert
  double f90 = 1;             ///< reflectance at grazing, at least 0; unused for Lambert
  std::vector<double> color;  ///< rho (Lambert) or f0 (GGX), one per channel, at least 0
};

/// A sum of analytic lobes, the fewest that the data require.
struct LobeSet {
  int channels = 3;
  std::vector<Lobe> lobes;
};

/// Reference value in double: f in 1/sr without cosine, added up over the lobes, into `f` (channels values);
/// 0 with either direction at or below the horizon. Symmetric in its directions to the last bit.
void eval_lobes(const LobeSet& set, const Vec3d& wi, const Vec3d& wo, std::span<double> f) noexcept;

}  // namespace brdf

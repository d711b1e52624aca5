// SPDX-License-Identifier: Apache-2.0
/// @file fresnel.h
/// Fresnel's equations of a smooth dielectric interface, and Schlick's approximation of them.
///
/// `cos_i` is the cosine between the direction and the normal, on the side that light comes from: 0 to 1, clamped (NaN
/// counts as 0). `eta` is the index of refraction of the far side over that of the near side, above 0. Every function is
/// noexcept and thread-safe; errors are in docs/numerics.md.
#pragma once

namespace brdf {

/// Shares of unpolarised light, and the direction in which what is transmitted goes on.
struct FresnelSplit {
  float reflected = 1;    ///< R; 1 in total internal reflection
  float transmitted = 0;  ///< T = 1 - R, with its own relative precision
  float cos_t = 0;        ///< cosine of the refracted direction, on the far side; 0 in total internal reflection
};

/// Exact, as the mean of both polarisations.
FresnelSplit fresnel_split(float cos_i, float eta) noexcept;

/// R of fresnel_split.
float fresnel_dielectric(float cos_i, float eta) noexcept;

/// f0 + (f90 - f0) (1 - cos_i)^5 (Schlick 1994, eq. 24).
float schlick(float cos_i, float f0, float f90 = 1) noexcept;

/// Reflectance at normal incidence, ((eta - 1) / (eta + 1))^2.
float schlick_f0(float eta) noexcept;

/// Schlick's approximation of fresnel_dielectric: with the cosine on the thinner side, so that it knows total reflection.
float schlick_dielectric(float cos_i, float eta) noexcept;

}  // namespace brdf

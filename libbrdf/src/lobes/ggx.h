// SPDX-License-Identifier: Apache-2.0
// The isotropic GGX microfacet lobe, piece by piece. Directions are plain doubles and only the parameters are of type T,
// so that automatic differentiation can check the hand-written derivatives.
#pragma once

#include <cmath>

namespace brdf::lobes {

inline constexpr double min_alpha = 1e-5;
inline constexpr double max_alpha = 1.0;
inline constexpr double pi = 3.14159265358979323846;

/// Normal distribution, Walter et al. 2007 eq. 33. cos^2 (alpha^2 - 1) + 1 is written as sin^2 + alpha^2 cos^2: at
/// alpha 1e-5 the former loses every digit near the peak.
template <class T>
inline T ggx_ndf(double sin2_theta_h, double cos2_theta_h, const T& alpha) noexcept {
  const T a2 = alpha * alpha;
  const T q = sin2_theta_h + a2 * cos2_theta_h;
  return a2 / (pi * q * q);
}

/// cos theta (1 + 2 Lambda(theta)) = sqrt(cos^2 + alpha^2 sin^2), with Lambda of Heitz 2014 eq. 72. Finite at grazing,
/// where Lambda itself is not.
template <class T>
inline T ggx_slope_length(double cosine, const T& alpha) noexcept {
  using std::sqrt;
  const double c2 = cosine * cosine;
  const double s2 = c2 < 1 ? 1 - c2 : 0.0;
  return sqrt(c2 + alpha * alpha * s2);
}

/// Lambda of Heitz 2014 eq. 72, as (sqrt(1 + x) - 1) / 2 = x / (2 (1 + sqrt(1 + x))) to keep small values exact.
template <class T>
inline T ggx_lambda(double cosine, const T& alpha) noexcept {
  using std::sqrt;
  const double c2 = cosine * cosine;
  const double tan2 = c2 < 1 ? (1 - c2) / c2 : 0.0;
  const T x = alpha * alpha * tan2;
  return x / (2.0 * (1.0 + sqrt(1.0 + x)));
}

/// Smith height-correlated masking-shadowing, Heitz 2014 eq. 99.
template <class T>
inline T ggx_g2(double cos_i, double cos_o, const T& alpha) noexcept {
  return 1.0 / (1.0 + ggx_lambda(cos_i, alpha) + ggx_lambda(cos_o, alpha));
}

/// G2 / (4 cos_i cos_o) with the cosines cancelled: 1 / (2 (S_i cos_o + S_o cos_i)). `cos_low` <= `cos_high`: a fixed
/// order makes the sum symmetric to the last bit even where the compiler contracts it into a fused multiply-add.
template <class T>
inline T ggx_visibility(double cos_low, double cos_high, const T& alpha) noexcept {
  const T den = 2.0 * (ggx_slope_length(cos_low, alpha) * cos_high + ggx_slope_length(cos_high, alpha) * cos_low);
  return den < 1e-30 ? T(1e30) : 1.0 / den;  // two denormal cosines must not give infinity
}

/// (1 - cos theta_d)^5 of Schlick 1994 eq. 24, from the sine: 1 - cos cancels at small angles.
inline double schlick_weight(double sin_theta_d, double cos_theta_d) noexcept {
  const double x = sin_theta_d * sin_theta_d / (1 + cos_theta_d);
  const double x2 = x * x;
  return x2 * x2 * x;
}

/// f0 + (f90 - f0) weight, as a sum of terms that are never negative.
template <class T>
inline T schlick(const T& f0, const T& f90, double weight) noexcept {
  return f0 * (1 - weight) + f90 * weight;
}

}  // namespace brdf::lobes

// SPDX-License-Identifier: Apache-2.0
// Fresnel's equations in a form where nothing cancels.
#pragma once

#include <algorithm>
#include <cmath>

namespace brdf::analytic {

template <class T>
struct FresnelTerms {
  T reflected, transmitted;  ///< of unpolarised light
  T cos_t;                   ///< of the refracted direction
};

/// With c = cos_i, n the far index over the near one and g = n cos_t = sqrt(n^2 - 1 + c^2) (Snell):
///   r_s = (c - g) / (c + g)         = -(n^2 - 1) / (c + g)^2
///   r_p = (n^2 c - g) / (n^2 c + g) = (n^2 - 1) ((n^2 + 1) c^2 - 1) / (n^2 c + g)^2
/// (Born and Wolf, Principles of Optics, sec. 1.5.2, eq. 21). The right sides keep their digits where n is near 1, and T is
/// not taken as 1 - R, which would lose it at grazing.
template <class T>
inline FresnelTerms<T> fresnel_terms(T c, T n) noexcept {
  c = std::min(std::max(T(0), c), T(1));
  const T excess = (n - 1) * (n + 1), g2 = excess + c * c;
  if (!(g2 > 0)) return {T(1), T(0), T(0)};  // total internal reflection
  const T g = std::sqrt(g2), s = c + g, p = n * n * c + g;
  const T r_s = excess / (s * s), r_p = excess * ((n * n + 1) * c * c - 1) / (p * p);
  return {(r_s * r_s + r_p * r_p) / 2, 2 * c * g * (1 / (s * s) + n * n / (p * p)), std::min(g / n, T(1))};
}

}  // namespace brdf::analytic

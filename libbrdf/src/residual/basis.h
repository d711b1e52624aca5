// SPDX-License-Identifier: Apache-2.0
// The basis functions of the residual, shared by encoder and decoder.
#pragma once

#include "residual/grid_coordinates.h"
#include "residual/residual_code.h"

#include <cmath>
#include <vector>

namespace brdf::residual {

/// Basis parameters as numbers.
struct Basis {
  double kappa_h = 1, kappa_d = 1, window_h = 0.1, window_d = 0.1, epsilon = 0;
};

inline Basis basis_of(const BasisCodes& codes) noexcept {
  return {kappa_h_of(codes.kappa_h), kappa_d_of(codes.kappa_d), window_of(codes.window_h), window_of(codes.window_d),
          epsilon_of(codes.epsilon)};
}

/// f does not depend on phi_d at theta_h = 0 (isotropy) and theta_d = 0: the m-th harmonic vanishes there like the m-th
/// power of this factor, which rises to 1 within `width`.
inline double pole_window(double sin_theta, double width) noexcept {
  return sin_theta / std::sqrt(sin_theta * sin_theta + width * width);
}

/// cos(pi j u) for j = 0 .. count - 1 into out, by the Chebyshev recurrence.
template <class T>
inline void cosines(double cos_pi_u, int count, T* out) noexcept {
  double before = 1, now = cos_pi_u;
  for (int j = 0; j < count; ++j) {
    out[j] = static_cast<T>(before);
    const double next = 2 * cos_pi_u * now - before;
    before = now;
    now = next;
  }
}

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
// Integrals by halving intervals until two rules agree.
#pragma once

#include <array>
#include <cmath>

namespace brdf::test {

/// Integral of f from a to b to about `tolerance` (absolute): Gauss and Kronrod's rules of 7 and 15 points.
template <class F>
double integrate(const F& f, double a, double b, double tolerance, int depth = 18) {
  static constexpr std::array<double, 8> x = {0.991455371120812640, 0.949107912342758525, 0.864864423359769073, 0.741531185599394440,
                                              0.586087235467691130, 0.405845151377397167, 0.207784955007898468, 0};
  static constexpr std::array<double, 8> kronrod = {0.022935322010529225, 0.063092092629978553, 0.104790010322250184, 0.140653259715525919,
                                                    0.169004726639267903, 0.190350578064785410, 0.204432940075298892, 0.209482141084727828};
  static constexpr std::array<double, 4> gauss = {0.129484966168869693, 0.279705391489276668, 0.381830050505118945, 0.417959183673469388};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double fine = 0, coarse = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double v = x[i] == 0 ? f(middle) : f(middle - half * x[i]) + f(middle + half * x[i]);
    fine += kronrod[i] * v;
    if (i % 2 == 1) coarse += gauss[i / 2] * v;
  }
  if (depth == 0 || std::fabs(fine - coarse) * half <= tolerance) return fine * half;
  return integrate(f, a, middle, 0.5 * tolerance, depth - 1) + integrate(f, middle, b, 0.5 * tolerance, depth - 1);
}

}  // namespace brdf::test

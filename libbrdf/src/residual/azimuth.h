// SPDX-License-Identifier: Apache-2.0
// Which functions of phi_d a residual is made of, and so which symmetries it has.
#pragma once

#include <cmath>
#include <cstdint>

namespace brdf::residual {

enum class Azimuth : std::uint8_t {
  one_way = 0,     ///< cos(m phi_d): mirror-symmetric only
  symmetric = 1,   ///< cos(m phi_d), m even: mirror-symmetric, and reciprocal to the last bit
  reciprocal = 2,  ///< cos(m phi), m even, and sin((m + 1) phi), m odd, with phi = phi_d modulo pi: reciprocal only
};

constexpr bool is_reciprocal(Azimuth a) noexcept { return a != Azimuth::one_way; }
constexpr bool is_mirror_symmetric(Azimuth a) noexcept { return a != Azimuth::reciprocal; }
constexpr bool even_only(Azimuth a) noexcept { return a == Azimuth::symmetric; }

/// The function of phi_d that a coefficient with this m belongs to.
struct Harmonic {
  int order;
  bool sine;
};

constexpr Harmonic harmonic(int m, Azimuth a) noexcept {
  return a == Azimuth::reciprocal && m % 2 == 1 ? Harmonic{m + 1, true} : Harmonic{m, false};
}

/// Values of the harmonics m = 0 .. count - 1 at cos phi; for Azimuth::reciprocal phi is in [0, pi].
template <class T>
inline void harmonics(double cos_phi, Azimuth a, int count, T* out) noexcept {
  // cos(j phi) and sin(j phi) by the Chebyshev recurrence, j = 0 and 1 to begin with
  const double sine = std::sqrt(cos_phi * cos_phi < 1 ? 1 - cos_phi * cos_phi : 0.0);
  double c0 = 1, c1 = cos_phi, s0 = 0, s1 = sine;
  for (int m = 0; m < count; ++m) {
    out[m] = static_cast<T>(harmonic(m, a).sine ? s1 : c0);  // s1 is one order ahead of c0
    const double c2 = 2 * cos_phi * c1 - c0, s2 = 2 * cos_phi * s1 - s0;
    c0 = c1;
    c1 = c2;
    s0 = s1;
    s1 = s2;
  }
}

}  // namespace brdf::residual

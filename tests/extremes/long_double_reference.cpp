// SPDX-License-Identifier: Apache-2.0
#include "extremes/long_double_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::test {

namespace {

using Real = long double;
constexpr Real pi = std::numbers::pi_v<Real>;

/// The angles of docs/conventions.md from s = wi + wo and d = wi - wo, in forms that both directions enter alike:
/// |s| = 2 cos theta_d, |d| = 2 sin theta_d, wo.z - wi.z = 2 sin theta_h sin theta_d cos phi_d, and the part of s x d along
/// the normal is 4 sin theta_h sin theta_d cos theta_d sin phi_d.
struct Angles {
  Real theta_h, theta_d, phi_d;
};

Angles angles_of(const PairNumbers& p) {
  const Real sx = p[0] + p[3], sy = p[1] + p[4], sz = p[2] + p[5];
  const Real dx = p[0] - p[3], dy = p[1] - p[4], dz = p[2] - p[5];
  const Real s = std::sqrt(sx * sx + sy * sy + sz * sz), d = std::sqrt(dx * dx + dy * dy + dz * dz);
  return {std::atan2(std::sqrt(sx * sx + sy * sy), sz), std::atan2(d, s), std::atan2(sx * dy - sy * dx, -dz * s)};
}

Real ggx(const Lobe& lobe, PairNumbers p, std::size_t c) {
  const Real ci = p[2], co = p[5], alpha = static_cast<Real>(lobe.alpha), a2 = alpha * alpha;
  if (lobe.kind == LobeKind::retro_ggx) p[3] = -p[3], p[4] = -p[4];
  const Real sx = p[0] + p[3], sy = p[1] + p[4], sz = p[2] + p[5];
  const Real dx = p[0] - p[3], dy = p[1] - p[4], dz = p[2] - p[5];
  const Real across2 = sx * sx + sy * sy, s2 = across2 + sz * sz, d2 = dx * dx + dy * dy + dz * dz;
  const Real denominator = (across2 + a2 * sz * sz) / s2;
  const Real ndf = a2 / (pi * denominator * denominator);
  const Real visibility = 1 / (2 * (co * std::sqrt(ci * ci + a2 * (1 - ci * ci)) + ci * std::sqrt(co * co + a2 * (1 - co * co))));
  const Real m = d2 / (s2 + d2 + std::sqrt(s2 * (s2 + d2)));  // 1 - cos theta_d
  const Real f0 = static_cast<Real>(lobe.color[c]), f90 = static_cast<Real>(lobe.f90);
  return (f0 + (f90 - f0) * m * m * m * m * m) * ndf * visibility;
}

Real warp(Real t, Real kappa) { return t * (0.6L * (1 + kappa) / (t + kappa) + 0.4L); }

Real chord(Real theta) { return std::numbers::sqrt2_v<Real> * std::sin(theta / 2); }

Real half(std::uint16_t h) {
  const int exponent = (h >> 10) & 31, mantissa = h & 1023;
  const Real value = exponent == 0 ? std::ldexp(static_cast<Real>(mantissa), -24)
                                   : std::ldexp(static_cast<Real>(1024 + mantissa), exponent - 25);
  return (h & 0x8000) != 0 ? -value : value;
}

struct Node {
  std::size_t below, above;
  Real fraction;
};

Node node_of(Real u, int n) {
  const Real x = std::clamp<Real>(u, 0, 1) * static_cast<Real>(n - 1);
  const int i = std::clamp(static_cast<int>(x), 0, std::max(n - 2, 0));
  return {static_cast<std::size_t>(i), static_cast<std::size_t>(std::min(i + 1, n - 1)), x - static_cast<Real>(i)};
}

Real phi_position(const Angles& a, residual::Azimuth azimuth) {
  const Real c = std::cos(a.phi_d);
  const auto u_p = [](Real cosine, Real angle) {  // sqrt(1 - cos) = sqrt 2 sin(angle / 2)
    return cosine >= 0 ? chord(angle) / 2 : 1 - chord(pi - angle) / 2;
  };
  const Real phi = std::fabs(a.phi_d);
  switch (azimuth) {
    case residual::Azimuth::one_way: return u_p(c, phi);
    case residual::Azimuth::symmetric: return 2 * u_p(std::fabs(c), c >= 0 ? phi : pi - phi);
    case residual::Azimuth::reciprocal: return a.phi_d < 0 ? u_p(-c, pi - phi) : u_p(c, phi);
  }
  return 0;
}

/// Spacing of floats at x.
Real float_ulp(Real x) {
  const auto v = static_cast<float>(std::fabs(x));
  return v > 0 ? static_cast<Real>(std::nextafter(v, 2 * v + 1)) - static_cast<Real>(v) : 0;
}

}  // namespace

PairNumbers normalised(PairNumbers p) {
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}}) {
    const Real length = std::sqrt(p[k] * p[k] + p[k + 1] * p[k + 1] + p[k + 2] * p[k + 2]);
    for (std::size_t j = k; j < k + 3; ++j) p[j] /= length;
  }
  return p;
}

Real reference_lobes(const LobeSet& lobes, const PairNumbers& p, std::size_t c) {
  Real sum = 0;
  for (const Lobe& lobe : lobes.lobes)
    sum += lobe.kind == LobeKind::lambert ? static_cast<Real>(lobe.color[c]) / pi : ggx(lobe, p, c);
  return sum;
}

Real reference_ratio(const residual::ResidualGrid& grid, const PairNumbers& p, std::size_t c) {
  const Angles a = angles_of(p);
  const Node h = node_of(warp(chord(a.theta_h), static_cast<Real>(grid.kappa_h)), grid.n_h);
  const Node d = node_of(warp(chord(a.theta_d), static_cast<Real>(grid.kappa_d)), grid.n_d);
  const Node f = node_of(phi_position(a, grid.azimuth), grid.n_p);
  Real sum = 0;
  for (const auto& [i_h, w_h] : {std::pair{h.below, 1 - h.fraction}, std::pair{h.above, h.fraction}})
    for (const auto& [i_d, w_d] : {std::pair{d.below, 1 - d.fraction}, std::pair{d.above, d.fraction}})
      for (const auto& [i_p, w_p] : {std::pair{f.below, 1 - f.fraction}, std::pair{f.above, f.fraction}}) {
        const std::size_t node = i_p + static_cast<std::size_t>(grid.n_p) * (i_d + static_cast<std::size_t>(grid.n_d) * i_h);
        sum += w_h * w_d * w_p * half(grid.ratio[node * static_cast<std::size_t>(grid.channels) + c]);
      }
  return sum;
}

ReferenceResult reference_value(const LobeSet& lobes, const residual::ResidualGrid& grid, const PairNumbers& p, std::size_t c) {
  if (!(p[2] > 0) || !(p[5] > 0)) return {};
  const Real lobe_sum = reference_lobes(lobes, p, c);
  if (grid.empty()) return {lobe_sum, lobe_sum};
  const Real epsilon = static_cast<Real>(grid.epsilon), product = (lobe_sum + epsilon) * reference_ratio(grid, p, c);
  return {std::max<Real>(0, product - epsilon), product + epsilon};
}

double backward_error(const LobeSet& lobes, const residual::ResidualGrid& grid, const Vec3f& wi, const Vec3f& wo, std::size_t c,
                      float computed, double roundings, double most) {
  const PairNumbers p = pair_numbers(wi, wo);
  const Real y = static_cast<Real>(computed), unit = std::ldexp(static_cast<Real>(roundings), -24);
  const ReferenceResult exact = reference_value(lobes, grid, p, c);
  if (std::fabs(y - exact.value) <= unit * exact.scale) return 0;
  PairNumbers ulp;
  for (std::size_t j = 0; j < 6; ++j) ulp[j] = float_ulp(p[j]);
  const auto reached = [&](double k) {
    Real low = exact.value, high = exact.value;
    for (unsigned corner = 0; corner < 64; ++corner)
      for (const Real part : {0.5L, 1.0L}) {
        PairNumbers q = p;
        for (std::size_t j = 0; j < 6; ++j) q[j] += ((corner >> j) & 1U ? 1 : -1) * part * static_cast<Real>(k) * ulp[j];
        if (!(q[2] > 0) || !(q[5] > 0)) continue;
        const Real v = reference_value(lobes, grid, q, c).value;
        low = std::min(low, v);
        high = std::max(high, v);
        if (y >= low - unit * exact.scale && y <= high + unit * exact.scale) return true;
      }
    return false;
  };
  double above = 0.0625;
  while (!reached(above)) {
    if (above >= most) return most;
    above *= 2;
  }
  double below = above / 2;
  for (int step = 0; step < 5; ++step) {
    const double middle = 0.5 * (below + above);
    (reached(middle) ? above : below) = middle;
  }
  return above;
}

}  // namespace brdf::test

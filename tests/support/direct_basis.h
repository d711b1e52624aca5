// SPDX-License-Identifier: Apache-2.0
// The residual as docs/format.md defines it, summed term by term in double: no table, no recurrence.
#pragma once

#include "residual/reconstruct.h"

#include <brdf/direction.h>
#include <brdf/lobes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace brdf::test {

/// A place in the residual's domain, by angles.
struct ResidualAngles {
  double theta_h = 0, theta_d = 0, phi_d = 0;
};

inline ResidualAngles residual_angles(const Vec3d& wi, const Vec3d& wo) noexcept {
  const Vec3d s{wi.x + wo.x, wi.y + wo.y, wi.z + wo.z}, d{wi.x - wo.x, wi.y - wo.y, wi.z - wo.z};
  const auto length = [](const Vec3d& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); };
  const double across = std::hypot(s.x, s.y);
  ResidualAngles a;
  a.theta_h = std::atan2(across, s.z);
  a.theta_d = std::atan2(length(d), length(s));
  // d in the frame of the half vector: x' along its azimuth tilted down by theta_h, y' across
  const double ch = across > 0 ? s.x / across : 1, sh = across > 0 ? s.y / across : 0;
  const double along = ch * d.x + sh * d.y, side = -sh * d.x + ch * d.y;
  a.phi_d = std::atan2(side, std::cos(a.theta_h) * along - std::sin(a.theta_h) * d.z);
  return a;
}

/// The function of phi_d with number m.
inline double of_azimuth(int m, double phi_d, residual::Azimuth azimuth) {
  return azimuth == residual::Azimuth::reciprocal && m % 2 == 1 ? std::sin((m + 1) * phi_d) : std::cos(m * phi_d);
}

/// log of the ratio of channel `channel`.
inline double direct_log_ratio(const residual::Coefficients& c, std::size_t channel, const ResidualAngles& a) {
  const auto axis = [](double theta, double kappa) {
    const double t = std::numbers::sqrt2 * std::sin(theta / 2);
    return 0.6 * t * (1 + kappa) / (t + kappa) + 0.4 * t;
  };
  const double u_h = axis(a.theta_h, residual::kappa_h_of(c.basis.kappa_h));
  const double u_d = axis(a.theta_d, residual::kappa_d_of(c.basis.kappa_d));
  const auto window = [](double theta, double width) { return std::sin(theta) / std::hypot(std::sin(theta), width); };
  const double w = window(a.theta_h, residual::window_of(c.basis.window_h)) *
                   window(a.theta_d, residual::window_of(c.basis.window_d));
  const auto n = static_cast<std::size_t>(c.channels);
  const std::vector<double> matrix = residual::channel_matrix(c.transform, c.channels);
  double sum = 0;
  for (std::size_t j = 0; j < c.order.size(); ++j) {
    double value = 0;
    for (std::size_t t = 0; t < n; ++t) value += matrix[t * n + channel] * static_cast<double>(c.values[t][j]);
    const residual::Frequency f = c.order[j];
    sum += value * std::cos(std::numbers::pi * f.k * u_h) * std::cos(std::numbers::pi * f.l * u_d) *
           of_azimuth(f.m, a.phi_d, c.azimuth) * std::pow(w, c.azimuth == residual::Azimuth::reciprocal && f.m % 2 == 1 ? f.m + 1 : f.m);
  }
  return std::clamp(sum, -9.7, 10.39);
}

/// f of channel `channel` without any grid.
inline double direct_value(const residual::Coefficients& c, double lobes, std::size_t channel, const Vec3d& wi,
                           const Vec3d& wo) {
  const double epsilon = residual::epsilon_of(c.basis.epsilon);
  return std::max(0.0, (lobes + epsilon) * std::exp(direct_log_ratio(c, channel, residual_angles(wi, wo))) - epsilon);
}

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// f of the analytic models in double, in the form in which <brdf/analytic.h> writes it.
#pragma once

#include <brdf/analytic.h>
#include <brdf/direction.h>
#include <brdf/ggx_energy.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace brdf::test {

/// D G2 / (4 c_i c_o), for directions above the horizon.
inline double facet_shape(const GgxReflector& m, const Vec3d& wi, const Vec3d& wo) {
  const double ax = static_cast<double>(m.alpha_x), ay = static_cast<double>(m.alpha_y);
  const Vec3d s = wi + wo, h = s / std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
  const double q = h.x * h.x / (ax * ax) + h.y * h.y / (ay * ay) + h.z * h.z;
  const auto lambda = [&](const Vec3d& w) {
    return 0.5 * (std::sqrt(1 + (ax * ax * w.x * w.x + ay * ay * w.y * w.y) / (w.z * w.z)) - 1);
  };
  return 1 / (std::numbers::pi * ax * ay * q * q) / (1 + lambda(wi) + lambda(wo)) / (4 * wi.z * wo.z);
}

/// One value per channel; 0 for delta lobes and below the horizon.
inline std::vector<double> model_value(const AnalyticModel& model, const Vec3d& wi, const Vec3d& wo) {
  const bool above = wi.z > 0 && wo.z > 0;
  std::vector<double> f;
  if (const auto* diffuse = std::get_if<Lambert>(&model))
    for (const float rho : diffuse->albedo) f.push_back(above ? static_cast<double>(rho) / std::numbers::pi : 0);
  if (const auto* mirror = std::get_if<Mirror>(&model)) f.assign(mirror->reflectance.size(), 0.0);
  if (const auto* glass = std::get_if<Dielectric>(&model)) f.assign(static_cast<std::size_t>(glass->channels), 0.0);
  if (const auto* ggx = std::get_if<GgxReflector>(&model)) {
    f.assign(ggx->f0.size(), 0.0);
    if (!above) return f;
    const double shape = facet_shape(*ggx, wi, wo);
    const double cos_d = std::sqrt(0.5 + 0.5 * (wi.x * wo.x + wi.y * wo.y + wi.z * wo.z));
    for (std::size_t c = 0; c < f.size(); ++c) {
      const double f0 = static_cast<double>(ggx->f0[c]);
      f[c] = shape * (f0 + (1 - f0) * std::pow(1 - cos_d, 5));
    }
    if (!ggx->multiple_scattering) return f;
    const GgxEnergy energy(static_cast<double>(ggx->alpha_x));
    for (std::size_t c = 0; c < f.size(); ++c)
      f[c] += energy.compensation(wi.z, wo.z) * energy.compensation_color(schlick_mean(static_cast<double>(ggx->f0[c]), 1));
  }
  return f;
}

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
#include "lobes/lobe_jacobian.h"

#include "lobes/lambert.h"

#include <algorithm>
#include <cmath>

namespace brdf::lobes {

ShapeDerivative ggx_shape_derivative(const LobeGeometry& g, double alpha) noexcept {
  const double a2 = alpha * alpha;
  const double q = g.sin2_theta_h + a2 * g.cos2_theta_h;
  const double ndf = a2 / (pi * q * q);
  // d log D / d alpha = 2 / alpha - 4 alpha cos^2 / q, over one denominator so that nothing cancels off the peak
  const double log_ndf = 2 * (g.sin2_theta_h - a2 * g.cos2_theta_h) / (alpha * q);

  const double low2 = std::max(1 - g.cos_low * g.cos_low, 0.0), high2 = std::max(1 - g.cos_high * g.cos_high, 0.0);
  const double s_low = ggx_slope_length(g.cos_low, alpha), s_high = ggx_slope_length(g.cos_high, alpha);
  const double sum = s_low * g.cos_high + s_high * g.cos_low;
  if (2 * sum < 1e-30) return {ndf * 1e30, ndf * 1e30 * log_ndf};  // ggx_visibility is constant there
  const double log_visibility = -alpha * (low2 * g.cos_high / s_low + high2 * g.cos_low / s_high) / sum;
  const double value = ndf / (2 * sum);
  return {value, value * (log_ndf + log_visibility)};
}

void lobe_jacobian(const Lobe& lobe, const Vec3d& wi, const Vec3d& wo, const LobeJacobian& out) noexcept {
  for (const auto& s : {out.value, out.d_alpha, out.d_f90, out.d_color}) std::fill(s.begin(), s.end(), 0.0);
  if (!(wi.z > 0) || !(wo.z > 0)) return;
  const std::size_t n = lobe.color.size();
  if (lobe.kind == LobeKind::lambert) {
    for (std::size_t c = 0; c < n; ++c) {
      out.value[c] = lambert(lobe.color[c]);
      out.d_color[c] = inv_pi;
    }
    return;
  }
  const LobeGeometry g = lobe_geometry(lobe.kind, wi, wo);
  const ShapeDerivative shape = ggx_shape_derivative(g, lobe.alpha);
  for (std::size_t c = 0; c < n; ++c) {
    const double fresnel = schlick(lobe.color[c], lobe.f90, g.schlick_weight);
    out.value[c] = shape.value * fresnel;
    out.d_alpha[c] = shape.d_alpha * fresnel;
    out.d_f90[c] = shape.value * g.schlick_weight;
    out.d_color[c] = shape.value * (1 - g.schlick_weight);
  }
}

}  // namespace brdf::lobes

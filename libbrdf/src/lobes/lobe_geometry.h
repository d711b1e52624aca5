// SPDX-License-Identifier: Apache-2.0
// What a lobe needs to know of a pair of directions.
#pragma once

#include "geometry/half_difference.h"
#include "lobes/ggx.h"

#include <brdf/direction.h>
#include <brdf/lobes.h>

#include <algorithm>

namespace brdf::lobes {

/// Every value is the same bits after an exchange of the directions.
struct LobeGeometry {
  double sin2_theta_h = 0, cos2_theta_h = 1;
  double schlick_weight = 0;         ///< (1 - cos theta_d)^5
  double cos_low = 1, cos_high = 1;  ///< cos_i and cos_o, sorted
};

/// For a pair above the horizon. The retro lobe is the reflection lobe seen with wo turned by pi about the normal; its
/// exchange turns wi instead, which only flips signs of the half and difference vectors, so symmetry stays exact.
inline LobeGeometry lobe_geometry(LobeKind kind, const Vec3d& wi, const Vec3d& wo) noexcept {
  const double turn = kind == LobeKind::retro_ggx ? -1.0 : 1.0;
  const auto hd = geometry::half_difference<double>(wi, Vec3d{turn * wo.x, turn * wo.y, wo.z});
  LobeGeometry g;
  g.sin2_theta_h = hd.sin_theta_h * hd.sin_theta_h;
  g.cos2_theta_h = hd.cos_theta_h * hd.cos_theta_h;
  if (!(g.sin2_theta_h + g.cos2_theta_h > 0)) g.cos2_theta_h = 1;  // opposite at grazing: the sum underflows
  g.schlick_weight = schlick_weight(hd.sin_theta_d, hd.cos_theta_d);
  g.cos_low = std::min(wi.z, wo.z);
  g.cos_high = std::max(wi.z, wo.z);
  return g;
}

/// D G2 / (4 cos_i cos_o): the GGX lobe without its Fresnel factor.
template <class T>
inline T ggx_shape(const LobeGeometry& g, const T& alpha) noexcept {
  return ggx_ndf(g.sin2_theta_h, g.cos2_theta_h, alpha) * ggx_visibility(g.cos_low, g.cos_high, alpha);
}

}  // namespace brdf::lobes

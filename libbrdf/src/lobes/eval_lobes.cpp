// SPDX-License-Identifier: Apache-2.0
#include "lobes/ggx.h"
#include "lobes/lambert.h"
#include "lobes/lobe_geometry.h"

#include <brdf/lobes.h>

#include <algorithm>

namespace brdf {

void eval_lobes(const LobeSet& set, const Vec3d& wi, const Vec3d& wo, std::span<double> f) noexcept {
  std::fill(f.begin(), f.end(), 0.0);
  if (!(wi.z > 0) || !(wo.z > 0)) return;
  const std::size_t channels = std::min(f.size(), static_cast<std::size_t>(std::max(set.channels, 0)));
  for (const Lobe& lobe : set.lobes) {
    const std::size_t n = std::min(channels, lobe.color.size());
    if (lobe.kind == LobeKind::lambert) {
      for (std::size_t c = 0; c < n; ++c) f[c] += lobes::lambert(lobe.color[c]);
      continue;
    }
    const lobes::LobeGeometry g = lobes::lobe_geometry(lobe.kind, wi, wo);
    const double shape = lobes::ggx_shape(g, std::clamp(lobe.alpha, lobes::min_alpha, lobes::max_alpha));
    for (std::size_t c = 0; c < n; ++c) f[c] += shape * lobes::schlick(lobe.color[c], lobe.f90, g.schlick_weight);
  }
}

}  // namespace brdf

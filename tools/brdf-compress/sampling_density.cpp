// SPDX-License-Identifier: Apache-2.0
#include "sampling_density.h"

#include <brdf/fit.h>

#include <algorithm>

namespace brdf::cli {

Material sampling_density(const MaterialSource& source) {
  if (source.is_compressed()) return source.material();
  FitOptions quick;
  quick.max_lobes = 3;
  quick.starts = 1;
  quick.samples = 1500;
  quick.max_iterations = 25;
  LobeSet lobes = fit_lobes(source.measurement(), quick).lobes;
  const bool diffuse = std::any_of(lobes.lobes.begin(), lobes.lobes.end(),
                                   [](const Lobe& lobe) { return lobe.kind == LobeKind::lambert; });
  if (!diffuse) {
    // Lobes say nothing of what they miss, so a tenth of their strength is spread over the hemisphere.
    Lobe lambert;
    lambert.color.assign(static_cast<std::size_t>(lobes.channels), 0.0);
    for (const Lobe& lobe : lobes.lobes)
      for (std::size_t c = 0; c < lambert.color.size(); ++c) lambert.color[c] += 0.1 * lobe.color[c];
    lobes.lobes.push_back(std::move(lambert));
  }
  return Material::from_lobes(lobes);
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Which kinds of lobes a set has.
#pragma once

#include <brdf/lobes.h>

#include <algorithm>

namespace brdf::lobes {

inline bool has_retro_lobes(const LobeSet& set) noexcept {
  return std::any_of(set.lobes.begin(), set.lobes.end(), [](const Lobe& lobe) { return lobe.kind == LobeKind::retro_ggx; });
}

}  // namespace brdf::lobes

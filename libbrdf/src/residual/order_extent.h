// SPDX-License-Identifier: Apache-2.0
// How far a list of frequencies reaches along each axis.
#pragma once

#include "residual/coefficient_order.h"

#include <algorithm>
#include <span>

namespace brdf::residual {

inline Extent extent(std::span<const Frequency> order) noexcept {
  Extent e;
  for (const Frequency& f : order) {
    e.k = std::max(e.k, f.k + 1);
    e.l = std::max(e.l, f.l + 1);
    e.m = std::max(e.m, f.m + 1);
  }
  return e;
}

}  // namespace brdf::residual

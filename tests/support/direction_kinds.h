// SPDX-License-Identifier: Apache-2.0
// Pairs of directions where formulas lose their digits, by kind.
#pragma once

#include "support/direction_batch.h"

#include <string>
#include <vector>

namespace brdf::test {

struct DirectionKind {
  std::string name;
  DirectionBatch wi, wo;
  void push(const Vec3f& a, const Vec3f& b) {
    wi.push(a);
    wo.push(b);
  }
};

/// All of unit length up to rounding and above the horizon.
std::vector<DirectionKind> direction_kinds();

/// "wi x y z wo x y z"
std::string pair_words(const Vec3f& wi, const Vec3f& wo);

}  // namespace brdf::test

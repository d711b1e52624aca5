// SPDX-License-Identifier: Apache-2.0
// Pairs of directions at which software tends to break.
#pragma once

#include "direction_planes.h"

namespace brdf::cli {

struct TestPairs {
  DirectionPlanes wi, wo;
};

/// A fixed set: every combination of special angles (normal, grazing to the last float, on and below the horizon) in
/// mirror, retro and other azimuths, and pairs spread over both hemispheres.
TestPairs make_test_pairs();

/// `count` pairs above the horizon, uniform in solid angle, the same for the same seed.
TestPairs random_pairs(std::size_t count, std::uint64_t seed);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Chooses the direction pairs of a fit and looks the measurement up there.
#pragma once

#include "fit/sample_set.h"

#include <brdf/measurement.h>

#include <functional>
#include <span>

namespace brdf::fit {

/// f of a pair, and whether it was measured.
using Lookup = std::function<bool(const Vec3d& wi, const Vec3d& wo, std::span<double> f)>;

/// Up to `count` samples with both theta at most 85 degrees; unmeasured and non-finite ones are left out, so fewer come
/// back when little was measured. Negative values become 0. Deterministic.
SampleSet collect_samples(const Lookup& lookup, int channels, int count);

/// The same from a measurement.
SampleSet collect_samples(const Measurement& m, int count);

}  // namespace brdf::fit

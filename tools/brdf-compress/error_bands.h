// SPDX-License-Identifier: Apache-2.0
// Where the error of a candidate comes from: the figures that it would have if one part of it were perfect.
#pragma once

#include "material_source.h"

#include <brdf/metrics.h>

#include <functional>
#include <string>
#include <vector>

namespace brdf::cli {

/// Part of all pairs of directions: angles in degrees, `from` <= angle < `to`; or one channel, from = to = its index.
struct ErrorBand {
  std::string axis;  ///< "none", "theta_h", "theta_d", "theta_max" (the larger of theta_i and theta_o) or "channel"
  double from = 0, to = 0;
};

/// The bands that are looked at, "none" first.
std::vector<ErrorBand> error_bands(int channels);

/// Figures of the candidate with the reference's values within `band`.
ErrorReport score_without(const Comparison& comparison, const ErrorBand& band, const BatchEval& reference, const BatchEval& candidate);

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// The error of a finished file, measured on what a decoder makes of it.
#pragma once

#include <brdf/material.h>
#include <brdf/measurement.h>
#include <brdf/metrics.h>
#include <brdf/profile.h>

#include <cstddef>
#include <optional>
#include <span>

namespace brdf::encode {

/// One figure over the three that are reported, in decibels; larger is better. What a search for the best file of a size
/// compares. Of a report with errors under a profile nearly all are those.
double merit(const ErrorReport& r) noexcept;

/// Scores decoded files against one measurement. Single-pair evaluation throughout: the recorded figures must not depend
/// on the instruction set.
class Verification {
 public:
  /// With `asked` reports have the errors under that profile, too.
  Verification(const Measurement& m, double quality, int threads, const MaterialProfile* asked = nullptr);
  ErrorReport score(const Material& material) const;
  /// Of a file, or of one that is cut at a refinement boundary.
  ErrorReport score(std::span<const std::byte> bytes, EvalLevel level) const;

 private:
  MeasurementInterpolator reference_;
  Comparison comparison_;
  std::optional<ProfileComparison> asked_;
};

}  // namespace brdf::encode

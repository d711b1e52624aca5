// SPDX-License-Identifier: Apache-2.0
// What each step of the effort scale turns on. The one table that code, help and documents use.
#pragma once

#include <brdf/encode.h>
#include <brdf/fit.h>

#include <cstdint>
#include <span>

namespace brdf::encode {

/// One row: applies from `effort` on, up to the next row.
struct EffortStep {
  int effort;
  int max_lobes, starts, fit_samples, fit_iterations;  ///< of the lobe fit
  int bins_h, bins_d, bins_p;                          ///< resolution at which the measurement is averaged
  int substeps;                                        ///< places along each axis of a bin
  int coefficients;                                    ///< candidates per channel
  double image_quality;                                ///< share of the image rows in the error model; 0: none
  int passes;                                          ///< of rate-distortion optimisation per quantiser step
  int variants;                                        ///< bases tried in half/difference coordinates
  int slice_variants;                                  ///< ways tried to write the slices of a measurement that has them
  int table_variants;                                  ///< shapes and warps tried for the balanced table of such a one
  double verify_quality;                               ///< share of the queries that verify the file
};

std::span<const EffortStep> effort_steps() noexcept;

/// The row for an effort of 0 to 100.
const EffortStep& effort_step(int effort) noexcept;

}  // namespace brdf::encode

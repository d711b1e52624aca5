// SPDX-License-Identifier: Apache-2.0
// A measurement that was taken in slices, at the nodes of a frame of its own.
#pragma once

#include "residual/slice_frame.h"

#include <brdf/measurement.h>

#include <optional>
#include <vector>

namespace brdf::encode {

/// The frame of a measurement: its slices and resolution, its ndf rounded to steps of 2^-(ndf_step / 2) octaves. None
/// for tables in half/difference coordinates and for what the format cannot hold.
std::optional<residual::SliceFrame> slice_frame(const Measurement& m, int ndf_step);

/// The measurement at every node, as the rounded ndf places it; both halves of the circle averaged.
struct SliceSamples {
  std::size_t width = 0, half_height = 0, slices = 0, channels = 0;
  std::vector<double> value;  ///< [slice][v][u][channel]: 4 sigma / ndf f cos theta_o, at least 0
  std::vector<double> y;      ///< log(value + epsilon)
  std::size_t nodes() const noexcept { return slices * half_height * width; }
};

SliceSamples sample_slices(const Measurement& m, const residual::SliceFrame& frame);

}  // namespace brdf::encode

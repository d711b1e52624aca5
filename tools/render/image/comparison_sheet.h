// SPDX-License-Identifier: Apache-2.0
// A comparison as one picture.
#pragma once

#include "image/comparison.h"
#include "image/raster.h"

#include <string>
#include <vector>

namespace brdf::render {

/// What is written under the two pictures, a line each, e.g. what they were made of and how long they took. Lines that are too
/// long for the panel end in "..". ASCII.
struct SheetLabels {
  std::vector<std::string> reference, candidate;
};

/// Reference, candidate, signed difference of the exposed luminance (blue: candidate darker, red: brighter; the scale is the next
/// of 1, 2, 5 times a power of ten above the 99th percentile, written at its colour bar) and FLIP map from left to right, with
/// the figures of `result` below. Pictures narrower than 240 pixels are enlarged by a whole factor.
/// Throws Error invalid_argument when the pictures are not those of `result` in size.
Raster comparison_sheet(const Image& reference, const Image& candidate, const ComparisonResult& result,
                        const SheetLabels& labels, float exposure_stops);

}  // namespace brdf::render

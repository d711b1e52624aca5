// SPDX-License-Identifier: Apache-2.0
// Every figure on two pictures, beside what noise alone would make of it.
#pragma once

#include "image/noise_floor.h"
#include "image/plane.h"

#include <optional>

namespace brdf::render {

/// A figure, and its noise floor: the same figure between the reference and the reference plus noise_of_difference(), which is
/// what a candidate would get that differs by noise alone. For means of squares the floor is what noise adds on average;
/// for the others it is one draw of noise, taken to be symmetric.
struct Figure {
  double value = 0;
  std::optional<double> floor;
};

/// How a candidate differs from a reference. Each figure's definition is at the function of its name.
struct ComparisonResult {
  Figure psnr, ssim, flip, hdr_flip;          ///< of what the display shows at the exposure; hdr_flip chooses its own
  Figure relative_mse;                        ///< of the exposed radiance
  Figure mse, max_difference, mean_absolute;  ///< of the radiance as it is
  double mean_signed = 0;                     ///< of the radiance; positive: the candidate is brighter
  std::optional<double> mean_signed_deviation;
  // The squares without noise's share: of the radiance (unbiased), of the exposed radiance relative to the reference, and of
  // what the display shows, from which PSNR comes (both with the bias that squares_without_noise tells).
  std::optional<WithoutNoise> mse_without_noise, relative_mse_without_noise, displayed_mse_without_noise;
  Plane flip_map;
  Image difference;  ///< candidate - reference
};

/// Compares pictures of at least 11 x 11 pixels (SSIM's window) at an exposure in stops. Without `noise` no floors are given.
/// Throws Error invalid_argument: sizes that differ, also those of the halves. Thread-safe.
ComparisonResult compare_images(const Image& reference, const Image& candidate, const std::optional<NoisePair>& noise,
                                float exposure_stops = 0);

}  // namespace brdf::render

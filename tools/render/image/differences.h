// SPDX-License-Identifier: Apache-2.0
// Differences of two pictures pixel by pixel.
#pragma once

#include "image/image.h"

namespace brdf::render {

/// What psnr answers for equal pictures and at most: an error of 1e-5 of the display's range.
inline constexpr double psnr_cap = 100;

/// Peak signal to noise ratio in dB, -10 log10 of the mean squared difference of what the display shows: radiance times
/// 2^exposure_stops, clipped to [0, 1], encoded with sRGB's transfer function, not rounded to 8 bits. Capped at psnr_cap.
double psnr(const Image& reference, const Image& candidate, float exposure_stops);

/// -10 log10 of a mean squared difference, capped; what is not positive gives the cap.
double psnr_of(double mean_squared_difference) noexcept;

/// Mean over pixels and channels of the squared difference of what the display shows.
double displayed_mse(const Image& reference, const Image& candidate, float exposure_stops);

/// What keeps the relative error of black finite: 1 % of the squared white.
inline constexpr double relative_mse_offset = 0.01;

/// Relative mean squared error of the radiance times 2^exposure_stops, not clipped: the mean over pixels and channels of
/// (c - r)^2 / (r^2 + relative_mse_offset), as Rousselle, Knaus, Zwicker (ACM Transactions on Graphics 30(6), 2011) weigh it.
double relative_mse(const Image& reference, const Image& candidate, float exposure_stops);

/// Of the radiance as it is, over pixels and channels: no exposure, no clipping, in the radiance's unit.
struct RadianceDifference {
  double max_absolute = 0;
  double mean_absolute = 0;
  double mean_squared = 0;
  double mean_signed = 0;  ///< positive where the candidate is brighter
};
RadianceDifference radiance_difference(const Image& reference, const Image& candidate);

/// candidate - reference.
Image difference(const Image& reference, const Image& candidate);

// All throw Error invalid_argument for pictures whose sizes differ or that have no pixels.

}  // namespace brdf::render

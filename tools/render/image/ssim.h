// SPDX-License-Identifier: Apache-2.0
// Structural similarity: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", IEEE Transactions on Image Processing 13(4), 2004.
#pragma once

#include "image/plane.h"

namespace brdf::render {

/// Width of the window, and the least side of a picture that has an SSIM.
inline constexpr int ssim_window = 11;

/// Mean SSIM (eq. 17) of two planes of values in [0, 1]: windows of 11 x 11 under a Gaussian of standard deviation 1.5,
/// K1 = 0.01, K2 = 0.03, those windows alone that lie within the picture. 1 for equal planes, at least -1, symmetric.
/// Throws Error invalid_argument for sizes that differ or are less than the window's.
double ssim(const Plane& a, const Plane& b);

/// Of the luma (BT.709's weights) of what the display shows: radiance times 2^exposure_stops, clipped to [0, 1], encoded with
/// sRGB's transfer function, not rounded to 8 bits.
double ssim(const Image& reference, const Image& candidate, float exposure_stops);

}  // namespace brdf::render

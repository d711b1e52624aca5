// SPDX-License-Identifier: Apache-2.0
// What a display shows of a picture, for the metrics that judge what is seen.
#pragma once

#include "image/image.h"

namespace brdf::render {

/// Radiance times 2^exposure_stops, clipped to [0, 1]; NaN becomes 0. Linear.
Image exposed(const Image& image, float exposure_stops);

/// exposed() under sRGB's transfer function: encoded values in [0, 1], not rounded to 8 bits.
Image displayed(const Image& image, float exposure_stops);

}  // namespace brdf::render

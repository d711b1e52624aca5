// SPDX-License-Identifier: Apache-2.0
// What a picture needs of a spectral measurement.
#pragma once

#include <brdf/measurement.h>

namespace brdf::render {

/// The measurement with three channels, linear sRGB, as ChannelsToRgb makes them of each of its samples; one of three or fewer stays as
/// it is. Samples of an RGL table outside the gamut stay negative, as its noise does. Throws Error(invalid_argument) as ChannelsToRgb does.
Measurement rgb_measurement(Measurement m);

}  // namespace brdf::render

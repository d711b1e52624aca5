// SPDX-License-Identifier: Apache-2.0
// Numbers as colours.
#pragma once

#include "image/raster.h"

namespace brdf::render {

/// 0 (black) over purple and orange to 1 (light yellow), ever lighter; what is outside is clipped. Green's cubehelix ("A colour scheme
/// for the display of astronomical intensity images", Bull. Astr. Soc. India 39, 2011) with the turn that looks like magma.
Rgb8 sequential_colour(double value) noexcept;

/// -1 (dark blue) over light grey at 0 to 1 (dark red), equally light on both sides; what is outside is clipped.
Rgb8 diverging_colour(double value) noexcept;

}  // namespace brdf::render

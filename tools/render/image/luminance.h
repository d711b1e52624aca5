// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/direction.h>

namespace brdf::render {

/// Relative luminance of linear BT.709: its row of the matrix to XYZ.
inline float luminance(const Vec3f& rgb) noexcept { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <brdf/direction.h>

namespace brdf::render {

/// Y of linear RGB with BT.709's primaries.
inline float luminance(const Vec3f& rgb) noexcept { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

}  // namespace brdf::render

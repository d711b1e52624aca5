// SPDX-License-Identifier: Apache-2.0
// Labels on pictures, in letters of 5 x 7 dots.
#pragma once

#include "image/raster.h"

#include <string_view>

namespace brdf::render {

inline constexpr int glyph_advance = 6, line_advance = 11;  ///< dots from letter to letter and from line to line

/// Width in pixels of a text at `scale` pixels a dot.
int text_width(std::string_view text, int scale) noexcept;

/// Draws printable ASCII with the upper left corner of its first letter at (x, y), clipped at the raster's borders. Other
/// characters appear as a box.
void draw_text(Raster& raster, int x, int y, std::string_view text, int scale, Rgb8 colour);

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// The nodes between which a pair of directions lies.
#pragma once

#include "slices/slice_map.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace brdf::encode {

struct SliceCorner {
  std::size_t node;  ///< u + width * (v + half_height * slice)
  double weight;     ///< the eight add up to 1
};

inline std::array<SliceCorner, 8> slice_corners(const slices::SlicePoint& p, const residual::SliceFrame& frame) noexcept {
  const std::size_t width = frame.width, half = static_cast<std::size_t>(frame.half_height());
  const double x = static_cast<double>(p.u) * static_cast<double>(width - 1);
  const double y = std::min(static_cast<double>(p.v) * (frame.height - 1), static_cast<double>(half - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(x), width - 2), j = half > 1 ? std::min(static_cast<std::size_t>(y), half - 2) : 0;
  const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j), fs = static_cast<double>(p.fraction);
  std::array<SliceCorner, 8> out;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t up_x = k & 1U, up_y = half > 1 ? (k >> 1) & 1U : 0, up_s = (k >> 2) & 1U;
    const double wy = half > 1 ? (up_y != 0 ? fy : 1 - fy) : 0.5;
    out[k] = {i + up_x + width * (j + up_y + half * (p.slice + up_s)), (up_x != 0 ? fx : 1 - fx) * wy * (up_s != 0 ? fs : 1 - fs)};
  }
  return out;
}

}  // namespace brdf::encode

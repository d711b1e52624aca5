// SPDX-License-Identifier: Apache-2.0
#include "image/colour_maps.h"

#include <algorithm>
#include <cmath>

namespace brdf::render {
namespace {

std::uint8_t code(double encoded) noexcept { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0))); }

double not_nan(double value, double low) noexcept { return value >= low ? std::min(value, 1.0) : low; }

}  // namespace

Rgb8 sequential_colour(double value) noexcept {
  constexpr double start = 0.25, rotations = 0.42, saturation = 1.5;
  const double t = not_nan(value, 0);
  const double angle = 2 * 3.14159265358979323846 * (start / 3 + rotations * t);
  const double amplitude = saturation * t * (1 - t) / 2, c = std::cos(angle), s = std::sin(angle);
  return {code(t + amplitude * (-0.14861 * c + 1.78277 * s)), code(t + amplitude * (-0.29227 * c - 0.90649 * s)),
          code(t + amplitude * 1.97294 * c)};  // eq. 2
}

Rgb8 diverging_colour(double value) noexcept {
  const double t = not_nan(value, -1), m = std::abs(t);
  constexpr double neutral = 0.93;
  // Light to a full colour in the first half, then darker. The two sides swap red and blue, with green between.
  const double strong = neutral - 0.10 * m - 0.38 * m * m, middle = neutral - 1.25 * m + 0.37 * m * m,
               weak = neutral - 1.75 * m + 0.90 * m * m;
  return t >= 0 ? Rgb8{code(strong), code(middle), code(weak)} : Rgb8{code(weak), code(middle), code(strong)};
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Places in a latitude-longitude picture: +y is its top row, -z its middle column, +x right of it. Without branches: they would
// depend on the direction alone, which no processor can foretell.
#pragma once

#include <algorithm>
#include <brdf/direction.h>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

namespace brdf::render {

/// atan of a quotient of 0 to 1; error below 2e-6 (Hastings 1955, "Approximations for Digital Computers", sheet 11, whose
/// coefficients these are), a thousandth of a pixel of the largest map.
inline float arc_tangent(float x) noexcept {
  const float s = x * x;
  return x * (0.99997726f + s * (-0.33262347f + s * (0.19354346f + s * (-0.11643287f + s * (0.05265332f - s * 0.01172120f)))));
}

/// atan2(y, x) by it; 0 where both are.
inline float angle_of(float y, float x) noexcept {
  constexpr float pi = std::numbers::pi_v<float>;
  constexpr float base[] = {0, pi / 2, pi, pi / 2}, sign[] = {1, -1, -1, 1};
  const float a = std::abs(x), b = std::abs(y);
  const float angle = arc_tangent(std::min(a, b) / std::max(std::max(a, b), 1e-37f));
  const int octant = static_cast<int>(b > a) + 2 * static_cast<int>(x < 0);
  return std::copysign(base[octant] + sign[octant] * angle, y);
}

/// Place of a unit vector, both coordinates in [0, 1].
inline glm::vec2 place_of(const Vec3f& d) noexcept {
  constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
  // an arc tangent for the height, too: acos has no digits left near the poles
  const float theta = angle_of(std::sqrt(d.x * d.x + d.z * d.z), d.y);
  return {0.5f + angle_of(d.x, -d.z) * (0.5f * inverse_pi), theta * inverse_pi};
}

/// And back.
inline Vec3f direction_at(const glm::vec2& at) noexcept {
  constexpr float pi = std::numbers::pi_v<float>;
  const float theta = at.y * pi, phi = (at.x - 0.5f) * 2 * pi, s = std::sin(theta);
  return {s * std::sin(phi), std::cos(theta), -s * std::cos(phi)};
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "image/flip_colour.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace brdf::render {
namespace {

/// BT.709's matrix to XYZ at full precision: each primary scaled so that together they give the white D65 of luminance 1.
glm::dmat3 matrix_to_xyz() noexcept {
  const auto from_chromaticity = [](double x, double y) { return Vec3d(x / y, 1, (1 - x - y) / y); };
  const glm::dmat3 primaries(from_chromaticity(0.64, 0.33), from_chromaticity(0.30, 0.60), from_chromaticity(0.15, 0.06));
  const Vec3d scale = glm::inverse(primaries) * from_chromaticity(0.3127, 0.3290);
  return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

struct Space {
  glm::dmat3 to_xyz = matrix_to_xyz();
  glm::dmat3 from_xyz = glm::inverse(to_xyz);
  Vec3d white = to_xyz * Vec3d(1);
};

const Space& space() noexcept {
  static const Space instance;
  return instance;
}

double lab_response(double t) noexcept {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

}  // namespace

Vec3d opponent_from_linear(const Vec3d& rgb) noexcept {
  const Vec3d t = (space().to_xyz * rgb) / space().white;
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

Vec3d linear_from_opponent(const Vec3d& yxz) noexcept {
  const double y = (yxz.x + 16) / 116;
  return space().from_xyz * (Vec3d(y + yxz.y / 500, y, y - yxz.z / 200) * space().white);
}

Vec3d hunt_lab_from_linear(const Vec3d& rgb) noexcept {
  const Vec3d t = (space().to_xyz * rgb) / space().white;
  const double x = lab_response(t.x), y = lab_response(t.y), z = lab_response(t.z);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double hyab(const Vec3d& a, const Vec3d& b) noexcept { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

}  // namespace brdf::render

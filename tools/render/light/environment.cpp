// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "light/luminance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Values of pixels beyond the left and right edge are those of the other side; the poles repeat their row.
const Vec3f& wrapped(const Image& map, int x, int y) noexcept {
  return map.at((x + map.width) % map.width, std::clamp(y, 0, map.height - 1));
}

/// Mean over pixel (x, y) of the bilinear interpolation of luminance: along each axis 1/8, 6/8, 1/8.
double bilinear_mean(const Image& map, int x, int y) noexcept {
  constexpr double weight[3] = {0.125, 0.75, 0.125};
  double sum = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) sum += weight[i] * weight[j] * static_cast<double>(luminance(wrapped(map, x + i - 1, y + j - 1)));
  return sum;
}

}  // namespace

Vec3f direction_at(const glm::vec2& uv) noexcept {
  const float theta = uv.y * pi, phi = (uv.x - 0.5f) * 2 * pi, s = std::sin(theta);
  return {s * std::sin(phi), std::cos(theta), -s * std::cos(phi)};
}

glm::vec2 place_of(const Vec3f& d) noexcept {
  // atan2 for the height, too: acos has no digits left near the poles
  const float theta = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y);
  return {0.5f + std::atan2(d.x, -d.z) / (2 * pi), theta / pi};
}

Environment::Environment(const Vec3f& radiance) : constant_(radiance), power_(4 * pi * luminance(radiance)) {}

Environment::Environment(Image map, float turn) : map_(std::move(map)), turn_(turn) {
  const auto width = static_cast<std::size_t>(map_.width), height = static_cast<std::size_t>(map_.height);
  std::vector<double> weights(width * height);
  const double row_angle = std::numbers::pi / map_.height;
  for (int y = 0; y < map_.height; ++y) {
    // exact solid angle of a pixel of this row, over that of its column's part of the sphere
    const double share = std::cos(y * row_angle) - std::cos((y + 1) * row_angle);
    for (int x = 0; x < map_.width; ++x) {
      weights[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = share * bilinear_mean(map_, x, y);
    }
  }
  density_ = PiecewiseConstant2D(weights, width, height);
  power_ = static_cast<float>(density_.sum() * 2 * std::numbers::pi / map_.width);
}

glm::vec2 Environment::place(const Vec3f& direction) const noexcept {
  glm::vec2 uv = place_of(direction);
  uv.x -= turn_ / (2 * pi);
  uv.x -= std::floor(uv.x);
  return uv;
}

Vec3f Environment::radiance(const Vec3f& direction) const noexcept {
  if (map_.pixels.empty()) return constant_;
  const glm::vec2 uv = place(direction);
  const float x = uv.x * static_cast<float>(map_.width) - 0.5f, y = uv.y * static_cast<float>(map_.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), s = x - left, t = y - top;
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  return (wrapped(map_, i, j) * (1 - s) + wrapped(map_, i + 1, j) * s) * (1 - t) +
         (wrapped(map_, i, j + 1) * (1 - s) + wrapped(map_, i + 1, j + 1) * s) * t;
}

float Environment::pdf(const Vec3f& direction) const noexcept {
  if (map_.pixels.empty()) return 1 / (4 * pi);
  // du dv = dw / (2 pi^2 sin theta)
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return sine > 0 ? density_.density(place(direction)) / (2 * pi * pi * sine) : 0;
}

Vec3f Environment::sample(const glm::vec2& u, float& pdf) const noexcept {
  if (map_.pixels.empty()) {
    pdf = 1 / (4 * pi);
    const float z = 1 - 2 * u.x, s = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * pi * u.y;
    return {s * std::cos(phi), z, s * std::sin(phi)};
  }
  const PiecewiseConstant2D::Draw draw = density_.sample(u);
  glm::vec2 uv = draw.at;
  const float sine = std::sin(uv.y * pi);
  pdf = sine > 0 ? draw.density / (2 * pi * pi * sine) : 0;
  uv.x += turn_ / (2 * pi);
  return direction_at(uv);
}

}  // namespace brdf::render

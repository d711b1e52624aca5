// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "image/luminance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// atan of a quotient of 0 to 1; error below 2e-6 (Hastings 1955, "Approximations for Digital Computers", sheet 11, whose
/// coefficients these are), a thousandth of a pixel of the largest map.
inline float arc_tangent(float x) noexcept {
  const float s = x * x;
  return x * (0.99997726f + s * (-0.33262347f + s * (0.19354346f + s * (-0.11643287f + s * (0.05265332f - s * 0.01172120f)))));
}

/// atan2(y, x) by it.
inline float angle_of(float y, float x) noexcept {
  const float a = std::abs(x), b = std::abs(y), larger = std::max(a, b);
  float angle = larger > 0 ? arc_tangent(std::min(a, b) / larger) : 0.0f;
  if (b > a) angle = 0.5f * pi - angle;
  if (x < 0) angle = pi - angle;
  return std::copysign(angle, y);
}

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
  const float theta = angle_of(std::sqrt(d.x * d.x + d.z * d.z), d.y);
  return {0.5f + angle_of(d.x, -d.z) * (0.5f / pi), theta * (1 / pi)};
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

Vec3f Environment::radiance_at(const glm::vec2& uv) const noexcept {
  const float x = uv.x * static_cast<float>(map_.width) - 0.5f, y = uv.y * static_cast<float>(map_.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), s = x - left, t = y - top;
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  // the seam joins both sides; the poles repeat their row
  const auto i0 = static_cast<std::size_t>(i < 0 ? map_.width - 1 : i), i1 = static_cast<std::size_t>(i + 1 >= map_.width ? 0 : i + 1);
  const auto width = static_cast<std::size_t>(map_.width);
  const Vec3f* upper = map_.pixels.data() + static_cast<std::size_t>(std::max(j, 0)) * width;
  const Vec3f* lower = map_.pixels.data() + static_cast<std::size_t>(std::min(j + 1, map_.height - 1)) * width;
  return (upper[i0] * (1 - s) + upper[i1] * s) * (1 - t) + (lower[i0] * (1 - s) + lower[i1] * s) * t;
}

Vec3f Environment::radiance(const Vec3f& direction) const noexcept {
  return map_.pixels.empty() ? constant_ : radiance_at(place(direction));
}

float Environment::pdf(const Vec3f& direction) const noexcept {
  float pdf;
  (void)radiance_pdf(direction, pdf);
  return pdf;
}

Vec3f Environment::radiance_pdf(const Vec3f& direction, float& pdf) const noexcept {
  if (map_.pixels.empty()) {
    pdf = 1 / (4 * pi);
    return constant_;
  }
  const glm::vec2 uv = place(direction);
  // du dv = dw / (2 pi^2 sin theta)
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  pdf = sine > 0 ? density_.density(uv) / (2 * pi * pi * sine) : 0;
  return radiance_at(uv);
}

Vec3f Environment::sample(const glm::vec2& u, float& pdf) const noexcept {
  Vec3f ignored;
  return sample_radiance(u, pdf, ignored);
}

Vec3f Environment::sample_radiance(const glm::vec2& u, float& pdf, Vec3f& radiance) const noexcept {
  if (map_.pixels.empty()) {
    pdf = 1 / (4 * pi);
    radiance = constant_;
    const float z = 1 - 2 * u.x, s = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * pi * u.y;
    return {s * std::cos(phi), z, s * std::sin(phi)};
  }
  const PiecewiseConstant2D::Draw draw = density_.sample(u);
  radiance = radiance_at(draw.at);
  const Vec3f direction = direction_at({draw.at.x + turn_ * (0.5f / pi), draw.at.y});
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  pdf = sine > 0 ? draw.density / (2 * pi * pi * sine) : 0;
  return direction;
}

}  // namespace brdf::render

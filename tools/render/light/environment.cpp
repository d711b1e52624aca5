// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "image/luminance.h"
#include "light/lat_long.h"

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

Environment::Environment(const Vec3f& radiance) : constant_(radiance), power_(4 * pi * luminance(radiance)) {}

Environment::Environment(Image map, float turn)
    : width_(static_cast<float>(map.width)), height_(static_cast<float>(map.height)), stride_(static_cast<std::uint32_t>(map.width) + 2), turn_(turn) {
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  std::vector<double> weights(width * height);
  const auto weight = [&](int x, int y) -> double& { return weights[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]; };
  const double row_angle = std::numbers::pi / map.height;
  for (int y = 0; y < map.height; ++y) {
    // exact solid angle of a pixel of this row, over that of its column's part of the sphere
    const double share = std::cos(y * row_angle) - std::cos((y + 1) * row_angle);
    for (int x = 0; x < map.width; ++x) weight(x, y) = share * bilinear_mean(map, x, y);
  }
  draws_ = PiecewiseConstant2D(weights, width, height);
  power_ = static_cast<float>(draws_.sum() * 2 * std::numbers::pi / map.width);
  const double mean = draws_.sum() / static_cast<double>(weights.size());
  pixels_.reserve(stride_ * (height + 2));
  for (int y = -1; y <= map.height; ++y) {
    for (int x = -1; x <= map.width; ++x) {
      const int column = (x + map.width) % map.width, row = std::clamp(y, 0, map.height - 1);
      pixels_.push_back({map.at(column, row), mean > 0 ? static_cast<float>(weight(column, row) / mean) : 1.0f});
    }
  }
}

Environment::Patch Environment::patch(const Vec3f& direction) const noexcept {
  if (pixels_.empty()) return {};
  glm::vec2 at = place_of(direction);
  at.x -= turn_ * (0.5f / pi);
  at.x -= std::floor(at.x);
  return patch_at(at);
}

Environment::Patch Environment::patch_at(const glm::vec2& at) const noexcept {
  // the border begins half a pixel before the first centre
  const float x = at.x * width_ + 0.5f, y = at.y * height_ + 0.5f;
  const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y);
  return {static_cast<std::uint32_t>(j) * stride_ + static_cast<std::uint32_t>(i), x - static_cast<float>(i), y - static_cast<float>(j)};
}

Vec3f Environment::radiance_in(const Patch& p, float& density) const noexcept {
  const Pixel *upper = &pixels_[p.upper_left], *lower = upper + stride_;
  // the pixel that the place is in has its centre nearest
  density = upper[static_cast<std::size_t>(p.s >= 0.5f) + stride_ * static_cast<std::size_t>(p.t >= 0.5f)].density;
  return (upper[0].radiance * (1 - p.s) + upper[1].radiance * p.s) * (1 - p.t) + (lower[0].radiance * (1 - p.s) + lower[1].radiance * p.s) * p.t;
}

Vec3f Environment::radiance(const Vec3f& direction, const Patch& patch, float& pdf) const noexcept {
  if (pixels_.empty()) {
    pdf = 1 / (4 * pi);
    return constant_;
  }
  float density;
  const Vec3f radiance = radiance_in(patch, density);
  // du dv = dw / (2 pi^2 sin theta)
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  pdf = sine > 0 ? density / (2 * pi * pi * sine) : 0;
  return radiance;
}

PiecewiseConstant1D::Draw Environment::draw_row(float u) const noexcept {
  return pixels_.empty() ? PiecewiseConstant1D::Draw{u, 0} : draws_.sample_row(u);
}

Environment::Draw Environment::draw(const PiecewiseConstant1D::Draw& row, float u) const noexcept {
  if (pixels_.empty()) return {{u, row.x}, {}};
  const glm::vec2 at{draws_.sample_column(row.cell, u), row.x};
  return {at, patch_at(at)};
}

Vec3f Environment::sample(const Draw& drawn, float& pdf, Vec3f& radiance) const noexcept {
  if (pixels_.empty()) {
    pdf = 1 / (4 * pi);
    radiance = constant_;
    const float z = 1 - 2 * drawn.at.x, s = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * pi * drawn.at.y;
    return {s * std::cos(phi), z, s * std::sin(phi)};
  }
  float density;
  radiance = radiance_in(drawn.patch, density);
  const Vec3f direction = direction_at({drawn.at.x + turn_ * (0.5f / pi), drawn.at.y});
  const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  pdf = sine > 0 ? density / (2 * pi * pi * sine) : 0;
  return direction;
}

}  // namespace brdf::render

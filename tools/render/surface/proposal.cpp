// SPDX-License-Identifier: Apache-2.0
#include "surface/proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace brdf::render {
namespace {

constexpr float inverse_pi = std::numbers::inv_pi_v<float>;
constexpr float below_one = 0x1.fffffep-1F;

}  // namespace

Vec3f cosine_direction(float u, float v) noexcept {
  const float a = 2 * u - 1, b = 2 * v - 1;
  constexpr float quarter = std::numbers::pi_v<float> / 4;
  float r = a, phi = 0;
  if (a * a > b * b) {
    phi = quarter * (b / a);
  } else if (b != 0) {
    r = b;
    phi = 2 * quarter - quarter * (a / b);
  }
  // z from the height itself would lose its digits near the horizon: 1 - r^2 as a product
  const float z = std::sqrt(std::max(0.0f, (1 - r) * (1 + r)));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

float Proposal::pdf(const Vec3f& wi, const Vec3f& wo) const noexcept {
  if (!(wi.z > 0) || !(wo.z > 0)) return 0;
  const float cosine = wi.z * inverse_pi;
  if (!material_) return cosine;
  return (1 - cosine_share_) * material_->pdf(wi, wo) + cosine_share_ * cosine;
}

Vec3f Proposal::sample(const Vec3f& wo, Vec3f u, float& pdf) const noexcept {
  pdf = 0;
  if (!(wo.z > 0)) return Vec3f(0);
  if (!material_ || u.x < cosine_share_) {
    const Vec3f wi = cosine_direction(u.y, u.z);
    pdf = this->pdf(wi, wo);
    return wi;
  }
  u.x = std::min((u.x - cosine_share_) / (1 - cosine_share_), below_one);
  std::array<float, 1024> weight;
  const Sample s = material_->sample(wo, u, weight);
  if (s.pdf > 0) pdf = (1 - cosine_share_) * s.pdf + cosine_share_ * s.wi.z * inverse_pi;
  return s.wi;
}

Proposal Proposal::of_lobes() const {
  return material_ ? Proposal(material_->prepare(EvalLevel::fast, true), cosine_share_) : Proposal();
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "analytic/specular.h"

#include "analytic/fresnel_terms.h"

#include <algorithm>
#include <cmath>

namespace brdf::analytic {
namespace {

/// Anything else has no direction: NaN, infinity, far from unit length.
bool is_direction(const Vec3f& w) noexcept { return w.x * w.x + w.y * w.y + w.z * w.z < max_direction_norm2; }

Sample nothing(std::span<float> weight) noexcept {
  std::fill(weight.begin(), weight.end(), 0.0f);
  return {};
}

}  // namespace

Sample MirrorScatter::sample(const Vec3f& wo, const Vec3f&, std::span<float> weight, TransportMode) const noexcept {
  if (!(wo.z > 0 && is_direction(wo))) return nothing(weight);
  std::copy(reflectance_.begin(), reflectance_.end(), weight.begin());
  return {{-wo.x, -wo.y, wo.z}, 1, 1, flags};
}

void MirrorScatter::albedo(const Vec3f& wo, std::span<float> a) const noexcept {
  if (wo.z > 0 && is_direction(wo))
    std::copy(reflectance_.begin(), reflectance_.end(), a.begin());
  else
    std::fill(a.begin(), a.end(), 0.0f);
}

Sample DielectricScatter::sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) const noexcept {
  if (!(wo.z != 0 && is_direction(wo))) return nothing(weight);
  const double eta = wo.z > 0 ? ior_ : 1 / ior_, z = static_cast<double>(wo.z);
  const FresnelTerms<double> f = fresnel_terms(std::abs(z), eta);
  if (!(f.transmitted > 0) || static_cast<double>(u.x) < f.reflected) {
    std::fill(weight.begin(), weight.end(), 1.0f);
    return {{-wo.x, -wo.y, wo.z}, static_cast<float>(f.reflected), 1, sample_reflection | sample_delta};
  }
  // Snell: what lies in the surface shrinks by eta; the length is mended, as wo may miss 1 by a rounding
  const double x = -static_cast<double>(wo.x) / eta, y = -static_cast<double>(wo.y) / eta, down = z > 0 ? -f.cos_t : f.cos_t;
  const double length = std::sqrt(x * x + y * y + down * down);
  // Radiance is spread over, or squeezed into, another solid angle: L / n^2 is what an interface keeps (Veach 1997, sec.
  // 5.2). Importance and power are not.
  std::fill(weight.begin(), weight.end(), mode == TransportMode::radiance ? static_cast<float>(1 / (eta * eta)) : 1.0f);
  return {{static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(down / length)},
          static_cast<float>(f.transmitted),
          static_cast<float>(eta),
          sample_transmission | sample_delta};
}

void DielectricScatter::albedo(const Vec3f& wo, std::span<float> a) const noexcept {
  std::fill(a.begin(), a.end(), wo.z != 0 && is_direction(wo) ? 1.0f : 0.0f);  // R + T
}

}  // namespace brdf::analytic

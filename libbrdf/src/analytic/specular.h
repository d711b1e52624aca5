// SPDX-License-Identifier: Apache-2.0
// Delta lobes: the mirror and the smooth interface of two media.
#pragma once

#include <brdf/analytic.h>
#include <brdf/material.h>

#include <cstdint>
#include <span>
#include <vector>

namespace brdf::analytic {

/// Components of a direction are at most this long; longer ones are no directions. See eval::max_norm2.
inline constexpr float max_direction_norm2 = 4;

class MirrorScatter {
 public:
  explicit MirrorScatter(const Mirror& m) : reflectance_(m.reflectance) {}
  static constexpr std::uint32_t flags = sample_reflection | sample_delta;

  Sample sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) const noexcept;
  void albedo(const Vec3f& wo, std::span<float> a) const noexcept;

 private:
  std::vector<float> reflectance_;
};

class DielectricScatter {
 public:
  explicit DielectricScatter(const Dielectric& m) : ior_(static_cast<double>(m.ior)) {}
  static constexpr std::uint32_t flags = sample_reflection | sample_transmission | sample_delta;

  Sample sample(const Vec3f& wo, const Vec3f& u, std::span<float> weight, TransportMode mode) const noexcept;
  void albedo(const Vec3f& wo, std::span<float> a) const noexcept;

 private:
  double ior_;  ///< below over above
};

}  // namespace brdf::analytic

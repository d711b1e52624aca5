// SPDX-License-Identifier: Apache-2.0
// Smooth noise in space, a function of its arguments alone.
#pragma once

#include "shape/generators.h"

#include <cmath>
#include <cstdint>

namespace brdf::render {

/// Value at a lattice point, uniform in [-1, 1].
inline float lattice_value(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) noexcept {
  std::uint64_t h = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y)) * 0x9E3779B97F4A7C15U;
  h ^= (static_cast<std::uint64_t>(static_cast<std::uint32_t>(z)) << 32 | seed) * 0xC2B2AE3D27D4EB4FU;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9U;  // finaliser of SplitMix64 (Steele, Lea and Flood 2014)
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBU;
  return static_cast<float>((h ^ (h >> 31)) >> 40) * 0x1p-23F - 1;
}

/// Value noise, interpolated with the quintic of Perlin (2002), "Improving Noise", so that normals are smooth, too.
inline float lattice_noise(const Vec3f& p, std::uint32_t seed) noexcept {
  const Vec3f base(std::floor(p.x), std::floor(p.y), std::floor(p.z)), t = p - base;
  const Vec3f s = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
  const auto x = static_cast<std::int32_t>(base.x), y = static_cast<std::int32_t>(base.y), z = static_cast<std::int32_t>(base.z);
  const auto lerp = [](float a, float b, float w) { return a + (b - a) * w; };
  const auto row = [&](std::int32_t j, std::int32_t k) {
    return lerp(lattice_value(x, y + j, z + k, seed), lattice_value(x + 1, y + j, z + k, seed), s.x);
  };
  return lerp(lerp(row(0, 0), row(1, 0), s.y), lerp(row(0, 1), row(1, 1), s.y), s.z);
}

/// Octaves added up, scaled so that the amplitude is never exceeded.
inline float displacement(const Vec3f& p, const NoiseOptions& noise) noexcept {
  float sum = 0, whole = 0, weight = 1, frequency = noise.frequency;
  for (int i = 0; i < noise.octaves; ++i) {
    sum += weight * lattice_noise(p * frequency, noise.seed + static_cast<std::uint32_t>(i));
    whole += weight;
    weight *= 0.5f;
    frequency *= 2;
  }
  return noise.amplitude * sum / whole;
}

}  // namespace brdf::render

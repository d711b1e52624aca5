// SPDX-License-Identifier: Apache-2.0
// Random numbers of one path: they depend on seed, pixel and sample number alone, so neither threads nor passes matter.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace brdf::render {

class Random {
 public:
  Random() = default;
  Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) noexcept
      : state_(mix(mix(mix(seed + golden) + pixel * golden) + sample * golden)) {}

  /// Uniform multiple of 2^-24 in [0, 1).
  float next() noexcept { return static_cast<float>(mix(state_ += golden) >> 40) * 0x1p-24F; }
  glm::vec2 next2() noexcept {
    // both halves of one number
    const std::uint64_t bits = mix(state_ += golden);
    return {static_cast<float>(bits >> 40) * 0x1p-24F, static_cast<float>((bits >> 8) & 0xFFFFFFU) * 0x1p-24F};
  }
  glm::vec3 next3() noexcept {
    const float first = next();
    const glm::vec2 rest = next2();
    return {first, rest.x, rest.y};
  }

 private:
  // SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;
  static constexpr std::uint64_t mix(std::uint64_t x) noexcept {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    return x ^ (x >> 31);
  }
  std::uint64_t state_ = 0;
};

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// Random numbers that depend on (seed, index, dimension) alone, so that any row can be made without those before it.
#pragma once

#include <cstdint>

namespace brdf::cli {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

class CounterRandom {
 public:
  explicit constexpr CounterRandom(std::uint64_t seed) noexcept : key_(mix_bits(seed + golden)) {}

  constexpr std::uint64_t bits(std::uint64_t index, std::uint64_t dimension) const noexcept {
    return mix_bits(mix_bits(key_ + (index + 1) * golden) + (dimension + 1) * golden);
  }

  /// Uniform multiple of 2^-24 in [0, 1): every value is a float, none rounds up to 1.
  constexpr float uniform(std::uint64_t index, std::uint64_t dimension) const noexcept {
    return static_cast<float>(bits(index, dimension) >> 40) * 0x1p-24F;
  }

 private:
  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;
  std::uint64_t key_;
};

}  // namespace brdf::cli

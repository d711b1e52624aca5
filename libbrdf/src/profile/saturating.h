// SPDX-License-Identifier: Apache-2.0
// Sums that stop at the largest number: commutative and associative, unlike floating point, and never small by accident.
#pragma once

#include <cstdint>
#include <limits>

namespace brdf::profile {

constexpr void add_saturating(std::uint64_t& sum, std::uint64_t more) noexcept {
  sum = more > std::numeric_limits<std::uint64_t>::max() - sum ? std::numeric_limits<std::uint64_t>::max() : sum + more;
}

/// value * units, rounded; 0 for what is not above 0, and at most `largest` * units.
constexpr std::uint64_t fixed_point(double value, double units, double largest) noexcept {
  if (!(value > 0)) return 0;
  return static_cast<std::uint64_t>((value < largest ? value : largest) * units + 0.5);
}

}  // namespace brdf::profile

// SPDX-License-Identifier: Apache-2.0
// Plain numbers in the range coder's stream.
#pragma once

#include <bit>
#include <cstdint>

namespace brdf::residual {

/// A count below 2^15: four bits for its width, then the bits below the leading one.
template <class Coder>
std::uint32_t code_count(Coder& coder, std::uint32_t value) {
  const std::uint32_t width = coder.raw(4, static_cast<std::uint32_t>(std::bit_width(value)));
  if (width <= 1) return width;
  const int low = static_cast<int>(width) - 1;
  return (1U << low) | coder.raw(low, value & ((1U << low) - 1U));
}

}  // namespace brdf::residual

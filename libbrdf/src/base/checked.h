// SPDX-License-Identifier: Apache-2.0
// Size arithmetic that cannot wrap around. Numbers from files go through these before they reach an allocation or
// an offset.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace brdf::base {

/// a + b, or nothing when the sum does not fit.
constexpr std::optional<std::uint64_t> checked_add(std::uint64_t a, std::uint64_t b) noexcept {
  if (a > std::numeric_limits<std::uint64_t>::max() - b) return std::nullopt;
  return a + b;
}

/// a * b, or nothing when the product does not fit.
constexpr std::optional<std::uint64_t> checked_multiply(std::uint64_t a, std::uint64_t b) noexcept {
  if (b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b) return std::nullopt;
  return a * b;
}

/// Product of all factors (1 for none), or nothing when any partial product in the given order does not fit.
constexpr std::optional<std::uint64_t> checked_product(std::span<const std::uint64_t> factors) noexcept {
  std::uint64_t product = 1;
  for (const std::uint64_t factor : factors) {
    const std::optional<std::uint64_t> next = checked_multiply(product, factor);
    if (!next) return std::nullopt;
    product = *next;
  }
  return product;
}

/// Whether [offset, offset + length) lies within [0, size).
constexpr bool range_fits(std::uint64_t offset, std::uint64_t length, std::uint64_t size) noexcept {
  return offset <= size && length <= size - offset;
}

}  // namespace brdf::base

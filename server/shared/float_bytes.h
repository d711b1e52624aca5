// SPDX-License-Identifier: Apache-2.0
// Floats of messages: little-endian, whatever the machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace brdf::service {

static_assert(sizeof(float) == 4);

inline void swap_if_big(std::span<float> values) noexcept {
  if constexpr (std::endian::native == std::endian::big) {
    for (float& v : values) v = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(v)));
  }
}

/// Floats [first, first + out.size()) of `bytes`. Precondition: they are there.
inline void load_floats(std::string_view bytes, std::size_t first, std::span<float> out) noexcept {
  if (out.empty()) return;
  std::memcpy(out.data(), bytes.data() + first * sizeof(float), out.size_bytes());
  swap_if_big(out);
}

/// Writes `values` as floats [first, ...) of `bytes`. Precondition: there is room.
inline void store_floats(std::span<const float> values, std::string& bytes, std::size_t first) noexcept {
  if (values.empty()) return;
  char* to = bytes.data() + first * sizeof(float);
  std::memcpy(to, values.data(), values.size_bytes());
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint32_t bits = __builtin_bswap32(std::bit_cast<std::uint32_t>(values[i]));
      std::memcpy(to + i * sizeof(float), &bits, sizeof(bits));
    }
  }
}

/// The floats of `bytes` where they lie; null where the machine's are others, or where they are not aligned.
inline const float* floats_in_place(std::string_view bytes) noexcept {
  const bool aligned = reinterpret_cast<std::uintptr_t>(bytes.data()) % alignof(float) == 0;
  return std::endian::native == std::endian::little && aligned ? reinterpret_cast<const float*>(bytes.data()) : nullptr;
}
inline float* floats_in_place(std::string& bytes) noexcept { return const_cast<float*>(floats_in_place(std::string_view(bytes))); }

}  // namespace brdf::service

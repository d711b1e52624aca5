// SPDX-License-Identifier: Apache-2.0
// Bounds-checked little-endian cursor over bytes that nobody trusts.
#pragma once

#include <brdf/error.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

namespace brdf::base {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

/// Value of type T at the start of `bytes`, stored little-endian. Precondition: bytes.size() >= sizeof(T).
template <class T>
requires std::is_arithmetic_v<T>
inline T load_little_endian(std::span<const std::byte> bytes) noexcept {
  std::byte raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    raw[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i] = bytes[i];
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

/// Writes `value` little-endian to the start of `bytes`. Precondition: bytes.size() >= sizeof(T).
template <class T>
requires std::is_arithmetic_v<T>
inline void store_little_endian(T value, std::span<std::byte> bytes) noexcept {
  std::byte raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[i] = raw[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i];
  }
}

/// Reads forward; every read is checked against the end. The bytes must outlive the reader.
class ByteReader {
 public:
  /// `name` begins the sentence of every error.
  ByteReader(std::span<const std::byte> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}

  std::size_t position() const noexcept { return position_; }
  std::size_t remaining() const noexcept { return bytes_.size() - position_; }

  /// Next `count` bytes. Throws Error(truncated) when fewer are left; `what` names the part for people.
  std::span<const std::byte> take(std::uint64_t count, const char* what) {
    if (count > remaining()) {
      throw Error(ErrorCode::truncated, name_ + ": the file ends within " + what + ": it needs " +
                                            std::to_string(count) + " bytes from byte " + std::to_string(position_) +
                                            " on, the file has " + std::to_string(bytes_.size()) + " bytes");
    }
    const std::span<const std::byte> part = bytes_.subspan(position_, static_cast<std::size_t>(count));
    position_ += part.size();
    return part;
  }

  /// Next little-endian number.
  template <class T>
  requires std::is_arithmetic_v<T> T read(const char* what) { return load_little_endian<T>(take(sizeof(T), what)); }

 private:
  std::span<const std::byte> bytes_;
  std::string name_;
  std::size_t position_ = 0;
};

}  // namespace brdf::base

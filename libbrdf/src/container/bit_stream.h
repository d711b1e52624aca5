// SPDX-License-Identifier: Apache-2.0
// Bits in bytes, most significant first.
#pragma once

#include <brdf/error.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace brdf::container {

class BitWriter {
 public:
  /// The low `count` (at most 32) bits of `value`.
  void put(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) {
      if (used_ % 8 == 0) bytes_.push_back(std::byte{0});
      if (((value >> i) & 1U) != 0) bytes_.back() |= static_cast<std::byte>(0x80U >> (used_ % 8));
      ++used_;
    }
  }
  const std::vector<std::byte>& bytes() const noexcept { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t used_ = 0;
};

class BitReader {
 public:
  BitReader(std::span<const std::byte> bytes, const char* what) : bytes_(bytes), what_(what) {}
  std::uint32_t get(int count) {
    if (static_cast<std::size_t>(count) > bytes_.size() * 8 - used_)
      throw Error(ErrorCode::malformed, std::string(what_) + ": ends after " + std::to_string(bytes_.size()) +
                                            " bytes within a field of " + std::to_string(count) + " bits");
    std::uint32_t v = 0;
    for (int i = 0; i < count; ++i, ++used_)
      v = (v << 1) | ((static_cast<std::uint32_t>(bytes_[used_ / 8]) >> (7 - used_ % 8)) & 1U);
    return v;
  }
  /// What is left after padding to a whole byte, which must be zero.
  std::span<const std::byte> rest() {
    while (used_ % 8 != 0)
      if (get(1) != 0) throw Error(ErrorCode::malformed, std::string(what_) + ": padding bits are not zero");
    return bytes_.subspan(used_ / 8);
  }

 private:
  std::span<const std::byte> bytes_;
  const char* what_;
  std::size_t used_ = 0;
};

}  // namespace brdf::container

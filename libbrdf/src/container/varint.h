// SPDX-License-Identifier: Apache-2.0
// Unsigned LEB128: seven bits a byte, low ones first, the shortest form only.
#pragma once

#include "base/byte_reader.h"

#include <brdf/error.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace brdf::container {

inline void put_varint(std::vector<std::byte>& out, std::uint64_t v) {
  for (; v >= 0x80; v >>= 7) out.push_back(static_cast<std::byte>(static_cast<std::uint8_t>((v & 0x7F) | 0x80)));
  out.push_back(static_cast<std::byte>(v));
}

inline std::size_t varint_bytes(std::uint64_t v) noexcept {
  std::size_t n = 1;
  for (; v >= 0x80; v >>= 7) ++n;
  return n;
}

inline std::uint64_t read_varint(base::ByteReader& in, const char* what) {
  std::uint64_t v = 0;
  for (int shift = 0; shift < 56; shift += 7) {
    const auto b = in.read<std::uint8_t>(what);
    v |= std::uint64_t{b & 0x7FU} << shift;
    if ((b & 0x80U) == 0) {
      if (b == 0 && shift > 0) break;
      return v;
    }
  }
  throw Error(ErrorCode::malformed, std::string(what) + ": not a number in its shortest form");
}

}  // namespace brdf::container

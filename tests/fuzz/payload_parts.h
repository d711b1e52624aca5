// SPDX-License-Identifier: Apache-2.0
// What lies behind the checksums, which a fuzzer cannot guess: the input is cut into a component declaration and chunk
// payloads, and the header and checksums are made to fit.
#pragma once

#include "support/brdfc_parts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace brdf::test {

/// Input: component bytes behind their count, then chunks, each a code and a length byte before its payload.
inline FileParts payload_parts(std::span<const std::byte> in) {
  const auto take = [&in](std::size_t n) {
    const auto part = in.first(std::min(n, in.size()));
    in = in.subspan(part.size());
    return std::vector<std::byte>(part.begin(), part.end());
  };
  const auto number = [&take] {
    const auto byte = take(1);
    return byte.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(byte[0]);
  };
  FileParts p;
  p.component = take(number());
  while (!in.empty()) {
    const std::uint8_t code = number(), length = number();
    p.chunks.push_back({code, take(length), std::nullopt});
  }
  return p;
}

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// Texts from outside, as short as a message can carry.
#pragma once

#include <cstddef>
#include <string>

namespace brdf::service {

/// At most `bytes` of it, not in the middle of a character.
inline std::string utf8_prefix(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xc0) == 0x80) --bytes;
  return text.substr(0, bytes);
}

/// In quotes.
inline std::string excerpt(const std::string& text) { return "'" + utf8_prefix(text, 160) + (text.size() > 160 ? "...'" : "'"); }

}  // namespace brdf::service

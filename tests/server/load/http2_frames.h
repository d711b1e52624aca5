// SPDX-License-Identifier: Apache-2.0
// As much of HTTP/2 (RFC 9113) as a client needs that does not keep to it: frames written by hand.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace brdf::load::http2 {

inline constexpr std::string_view preface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";

enum class FrameType : std::uint8_t { data = 0, headers = 1, rst_stream = 3, settings = 4, ping = 6, window_update = 8, continuation = 9 };
inline constexpr std::uint8_t end_stream = 1, end_headers = 4;

inline std::string big_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

/// Section 4.1.
inline std::string frame(FrameType type, std::uint8_t flags, std::uint32_t stream, std::string_view payload) {
  std::string text = big_endian(payload.size(), 3);
  text += static_cast<char>(type);
  text += static_cast<char>(flags);
  return (text += big_endian(stream, 4)).append(payload);
}

/// A header field without indexing, name and value in full (RFC 7541, section 6.2.2). Both are shorter than 127 bytes.
inline std::string field(std::string_view name, std::string_view value) {
  std::string text(1, '\0');
  (text += static_cast<char>(name.size())) += name;
  return (text += static_cast<char>(value.size())) += value;
}

inline std::string call_headers(std::string_view path, std::string_view token) {
  std::string text = field(":method", "POST") + field(":scheme", "http") + field(":path", path) + field(":authority", "localhost") + field("content-type", "application/grpc") + field("te", "trailers");
  return token.empty() ? text : text + field("authorization", token);
}

/// A message with the length that gRPC puts before it.
inline std::string message(std::string_view bytes) { return std::string(1, '\0').append(big_endian(bytes.size(), 4)).append(bytes); }

}  // namespace brdf::load::http2

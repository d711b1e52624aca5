// SPDX-License-Identifier: Apache-2.0
#include "shared/content_hash.h"

#include <openssl/evp.h>

#include <algorithm>
#include <stdexcept>

namespace brdf::service {
namespace {

constexpr std::size_t version_bytes = 16;

}  // namespace

Sha256 sha256(std::span<const std::byte> bytes) {
  Sha256 digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), reinterpret_cast<unsigned char*>(digest.data()), &size, EVP_sha256(), nullptr) != 1 ||
      size != digest.size()) {
    throw std::runtime_error("libcrypto gives no SHA-256");
  }
  return digest;
}

std::string version_of(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  const Sha256 digest = sha256(bytes);
  std::string text;
  for (std::size_t i = 0; i < version_bytes; ++i) {
    const auto b = std::to_integer<unsigned>(digest[i]);
    text += digits[b >> 4];
    text += digits[b & 15];
  }
  return text;
}

bool is_version(std::string_view text) noexcept {
  return text.size() == 2 * version_bytes && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

}  // namespace brdf::service

// SPDX-License-Identifier: Apache-2.0
// Bearer tokens and what they open.
#pragma once

#include "shared/content_hash.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace brdf::service {

/// Each role may do what those before it may.
enum class Role : std::uint8_t { read, compress, admin };
const char* to_string(Role role) noexcept;

/// Only digests are kept, and every one is compared, in a time that does not depend on where they differ.
class Tokens {
 public:
  /// Lines 'ROLE TOKEN' or 'ROLE sha256:DIGEST'; empty lines and lines that start with # are skipped. Throws
  /// Error(invalid_argument) naming the line, never the token.
  static Tokens parse(std::string_view text, const std::string& name);
  /// Reads a file. Throws Error: io, and invalid_argument also where others than owner and group may read it.
  static Tokens read(const std::filesystem::path& file);

  /// The highest role of a token; nothing for an unknown one.
  std::optional<Role> role_of(std::string_view token) const;

 private:
  struct Entry {
    Role role;
    Sha256 digest;
  };
  std::vector<Entry> entries_;
};

}  // namespace brdf::service

// SPDX-License-Identifier: Apache-2.0
// Names of contents. SHA-256, because a cache that trusts a name must not be handed another file of the same name.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace brdf::service {

using Sha256 = std::array<std::byte, 32>;

Sha256 sha256(std::span<const std::byte> bytes);

/// Version of a material: the first half of the SHA-256 of its file, 32 lower-case hexadecimal digits.
std::string version_of(std::span<const std::byte> bytes);

/// Whether a text has the form of a version.
bool is_version(std::string_view text) noexcept;

}  // namespace brdf::service

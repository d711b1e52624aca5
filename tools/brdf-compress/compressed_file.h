// SPDX-License-Identifier: Apache-2.0
// `.brdfc` bytes: where they may be cut, and how they become a material.
#pragma once

#include <brdf/material.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace brdf::cli {

/// Lengths at which the file may be cut: after the lobes and after each refinement.
std::vector<std::uint64_t> refinement_ends(std::span<const std::byte> bytes, const std::string& path);

/// The first `prefix` bytes of a file that is longer; all bytes where no prefix is asked for or the file ends before.
/// Throws Failure(usage), naming the possible lengths, for a prefix that ends elsewhere.
std::vector<std::byte> cut_to_prefix(std::vector<std::byte> bytes, std::optional<std::uint64_t> prefix,
                                     const std::string& path);

/// Decodes; sentences of errors start with the path.
Material decode_file(std::span<const std::byte> bytes, EvalLevel level, bool allow_prefix, const std::string& path,
                     bool sampling = false);

}  // namespace brdf::cli

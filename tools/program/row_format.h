// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace brdf::cli {

/// How rows of numbers travel on stdin and stdout.
enum class RowFormat : std::uint8_t {
  csv,  ///< a line of text each; read with commas or blanks, empty lines and lines that start with # are skipped
  f32,  ///< raw little-endian float32
};

}  // namespace brdf::cli

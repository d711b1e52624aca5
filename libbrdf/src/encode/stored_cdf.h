// SPDX-License-Identifier: Apache-2.0
// A file that brings its sampling tables along.
#pragma once

#include <brdf/material.h>

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::encode {

/// The same file with the tables that sampling needs at `level`.
std::vector<std::byte> with_stored_cdf(std::span<const std::byte> bytes, EvalLevel level);

}  // namespace brdf::encode

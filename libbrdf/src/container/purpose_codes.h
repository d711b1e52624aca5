// SPDX-License-Identifier: Apache-2.0
// The chunk that says what a file is fit for. docs/format.md describes every byte.
#pragma once

#include <brdf/material.h>

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::container {

std::vector<std::byte> write_purpose(const FittedFor& purpose);

/// Throws Error(malformed).
FittedFor read_purpose(std::span<const std::byte> payload);

}  // namespace brdf::container

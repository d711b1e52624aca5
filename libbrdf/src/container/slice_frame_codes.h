// SPDX-License-Identifier: Apache-2.0
// The frame of a residual in slice coordinates as bytes.
#pragma once

#include "residual/slice_frame.h"

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::container {

std::vector<std::byte> write_slice_frame(const residual::SliceFrame& frame);

/// Reads a frame from the front of `bytes` and takes it off. Throws Error(malformed).
residual::SliceFrame read_slice_frame(std::span<const std::byte>& bytes);

/// Whether a frame can be evaluated; `why` says what is wrong.
bool is_valid(const residual::SliceFrame& frame, const char*& why) noexcept;

}  // namespace brdf::container

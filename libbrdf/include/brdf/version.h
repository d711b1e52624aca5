// SPDX-License-Identifier: Apache-2.0
/// @file version.h
#pragma once

namespace brdf {
inline constexpr int version_major = 0, version_minor = 1, version_patch = 0;
/// "0.1.0"
const char* version() noexcept;
}  // namespace brdf

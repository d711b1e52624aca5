// SPDX-License-Identifier: Apache-2.0
// First bytes that tell files apart.
#pragma once

#include <string_view>

namespace brdf::base {

inline constexpr std::string_view brdfc_magic = "BRFC";
inline constexpr std::string_view tensor_file_magic{"tensor_file\0", 12};  ///< with its NUL
inline constexpr std::string_view git_lfs_magic = "version https://git-lfs";

}  // namespace brdf::base

// SPDX-License-Identifier: Apache-2.0
// Where tests find files. One source file knows: with the paths in every command line no other checkout could share what the compiler made.
#pragma once

#include <filesystem>

namespace brdf::test {

/// This repository.
std::filesystem::path source_folder();

/// Measured files that are not part of it; need not exist.
std::filesystem::path shared_folder();

}  // namespace brdf::test

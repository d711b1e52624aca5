// SPDX-License-Identifier: Apache-2.0
#include "support/data_folders.h"

namespace brdf::test {

std::filesystem::path source_folder() { return BRDF_SOURCE_DIR; }
std::filesystem::path shared_folder() { return BRDF_SHARED_DIR; }

}  // namespace brdf::test

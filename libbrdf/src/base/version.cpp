// SPDX-License-Identifier: Apache-2.0
#include <brdf/version.h>

namespace brdf {
namespace {

// The build's version comes from CMakeLists.txt and the header's is written by hand: neither may drift.
static_assert(version_major == BRDF_VERSION_MAJOR && version_minor == BRDF_VERSION_MINOR &&
                  version_patch == BRDF_VERSION_PATCH,
              "brdf/version.h and CMakeLists.txt disagree");

}  // namespace

const char* version() noexcept { return BRDF_VERSION_STRING; }

}  // namespace brdf

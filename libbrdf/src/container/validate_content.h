// SPDX-License-Identifier: Apache-2.0
// What pack() refuses: contents that no decoder would read back.
#pragma once

#include "container/content.h"

namespace brdf::container {

/// Throws Error(invalid_argument) with the field, the value found and the value allowed.
void validate(const Content& content);

}  // namespace brdf::container

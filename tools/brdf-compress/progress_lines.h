// SPDX-License-Identifier: Apache-2.0
// Progress for a program that runs this one.
#pragma once

#include <brdf/progress.h>

namespace brdf::cli {

/// Lines "0.25 fitting lobes" to a descriptor, at most ten a second and one for each new stage; a share never falls. A
/// reader that has gone away is no error.
Progress progress_lines(int descriptor);

}  // namespace brdf::cli

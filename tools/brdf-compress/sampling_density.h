// SPDX-License-Identifier: Apache-2.0
// What `sample` and `pdf` draw from.
#pragma once

#include "material_source.h"

namespace brdf::cli {

/// The material itself for a compressed source. For a measured one a few lobes fitted to it, whose density always
/// has a cosine part and so reaches every direction; the same file gives the same density each time.
Material sampling_density(const MaterialSource& source);

}  // namespace brdf::cli

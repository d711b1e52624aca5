// SPDX-License-Identifier: Apache-2.0
// Any material as a table in MERL's layout.
#pragma once

#include "material_source.h"

#include <cstddef>
#include <vector>

namespace brdf::cli {

struct MerlExport {
  SamplePosition position = SamplePosition::edge;
  bool full_circle = false;  ///< 360 bins of phi_d, which keeps what is not reciprocal
};

/// The bytes of the table; -1 where a direction is below the horizon or nothing was measured. A MERL table that has the
/// wanted shape already keeps its samples. Throws Failure(bad_input) for other than three channels.
std::vector<std::byte> export_merl(const MaterialSource& source, const MerlExport& wanted);

}  // namespace brdf::cli

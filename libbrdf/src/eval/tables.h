// SPDX-License-Identifier: Apache-2.0
// Everything that evaluation reads.
#pragma once

#include "eval/grid_params.h"
#include "eval/lobe_params.h"
#include "slices/slice_table.h"

namespace brdf::eval {

struct Tables {
  LobeParams lobes;
  GridParams grid;
  slices::SliceView slices;  ///< with values: f is what they say, without lobes and grid
};

}  // namespace brdf::eval

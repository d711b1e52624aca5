// SPDX-License-Identifier: Apache-2.0
// What the tables of a level cost, known before they are built. decode, prepare and check_file share it.
#pragma once

#include "residual/reconstruct.h"

#include <brdf/check.h>
#include <brdf/limits.h>
#include <brdf/lobes.h>
#include <brdf/material.h>

#include <cstdint>
#include <optional>

namespace brdf::decode {

struct MemoryNeed {
  std::uint64_t tables = 0;     ///< bytes that stay
  std::uint64_t temporary = 0;  ///< beside them at most, while they are built; `reading` included
};

/// `reading`: Unpacked::temporary_bytes, of which the sum of the layers stays. The sampling tables' temporary bytes count,
/// the tables themselves, whose size no file changes, do not.
MemoryNeed memory_need(const residual::Coefficients& c, EvalLevel level, std::uint64_t reading) noexcept;

/// The Error(limit_exceeded) that building a level throws, or nothing.
std::optional<Error> beyond_limits(const MemoryNeed& need, EvalLevel level, const DecodeLimits& limits);

/// Bytes of the sampling tables of a material.
std::uint64_t sampling_table_bytes(const LobeSet& lobes) noexcept;

/// The size of the grid of a level; a residual in slices has none at `exact`.
const residual::GridSize& grid_size(const residual::Coefficients& c, EvalLevel level) noexcept;

}  // namespace brdf::decode

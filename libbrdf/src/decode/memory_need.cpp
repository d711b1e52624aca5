// SPDX-License-Identifier: Apache-2.0
#include "decode/memory_need.h"

#include "decode/resample_slices.h"
#include "lobes/lobe_kinds.h"
#include "sample/build_density.h"
#include "sample/density.h"
#include "slices/slice_table.h"

#include <algorithm>
#include <string>

namespace brdf::decode {
namespace {

using sample::ComponentTable;

MemoryNeed table_need(const residual::Coefficients& c, EvalLevel level) noexcept {
  if (level == EvalLevel::fast || c.order.empty()) return {};
  if (!c.slices.empty() && level == EvalLevel::exact)
    return {slices::SliceTable::bytes_of(c.slices, c.channels), slices::SliceTable::temporary_bytes_of(c.slices, c.channels)};
  const residual::GridSize& size = grid_size(c, level);
  const std::uint64_t bytes = residual::grid_bytes(size, c.azimuth, c.channels);
  return {bytes, c.slices.empty() ? residual::reconstruct_temporary_bytes(c, size) : resample_temporary_bytes(c.slices, c.channels, size)};
}

std::string sentence(EvalLevel level, const char* what, std::uint64_t bytes, std::uint64_t limit) {
  return "the " + std::string(to_string(level)) + " table needs " + std::to_string(bytes) + " bytes" + what + ", the limit is " + std::to_string(limit);
}

}  // namespace

const residual::GridSize& grid_size(const residual::Coefficients& c, EvalLevel level) noexcept {
  return level == EvalLevel::exact ? residual::exact_grid : residual::balanced_grids[c.basis.table];
}

MemoryNeed memory_need(const residual::Coefficients& c, EvalLevel level, std::uint64_t reading) noexcept {
  MemoryNeed need = table_need(c, level);
  need.temporary = reading + std::max(need.temporary, sample::build_density_temporary_bytes(c.channels));
  return need;
}

std::optional<Error> beyond_limits(const MemoryNeed& need, EvalLevel level, const DecodeLimits& limits) {
  if (need.tables > limits.max_table_bytes)
    return Error(ErrorCode::limit_exceeded, sentence(level, "", need.tables, limits.max_table_bytes));
  if (need.temporary > limits.max_temporary_bytes)
    return Error(ErrorCode::limit_exceeded, sentence(level, " while it is built", need.temporary, limits.max_temporary_bytes));
  return std::nullopt;
}

std::uint64_t sampling_table_bytes(const LobeSet& set) noexcept {
  constexpr std::uint64_t table = ComponentTable::views * (1 + ComponentTable::rows_per_view) * (sizeof(sample::DensityRow) + sizeof(sample::QuarterRow));
  return sizeof(Material::Sampling) + (lobes::has_retro_lobes(set) ? 2 : 1) * table;
}

}  // namespace brdf::decode

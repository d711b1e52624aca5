// SPDX-License-Identifier: Apache-2.0
#include "analytic/scatterer.h"
#include "container/content.h"
#include "decode/memory_need.h"
#include "eval/lobe_params.h"

#include <brdf/check.h>

#include <utility>

namespace brdf {
namespace {

void check(std::span<const std::byte> bytes, const DecodeLimits& limits, bool allow_prefix, FileCheck& found) {
  const container::Unpacked file = container::unpack(bytes, limits, allow_prefix);
  const container::Content& content = file.content;
  if (content.analytic) {
    found.total_bytes = file.total_bytes;
    found.channels = content.component.channels.count;
    found.lobes = static_cast<int>(analytic::equal_lobes(*content.analytic).lobes.size());
    for (LevelCheck& level : found.levels) level.temporary_bytes = file.temporary_bytes;
    return;
  }
  const eval::LobeParams evaluated(content.lobes);  // refuses what no kernel could evaluate
  residual::Coefficients c = residual::dequantise(content.residual, content.component.transform, content.residual.layers.size());
  c.channels = content.component.channels.count;
  found.total_bytes = file.total_bytes;
  found.channels = c.channels;
  found.refinements_read = file.refinements_read;
  found.refinements_total = file.refinements_total;
  found.lobes = static_cast<int>(content.lobes.lobes.size());
  found.sampling_bytes = decode::sampling_table_bytes(content.lobes);
  for (const EvalLevel level : {EvalLevel::fast, EvalLevel::balanced, EvalLevel::exact}) {
    const decode::MemoryNeed need = decode::memory_need(c, level, file.temporary_bytes);
    found.levels[static_cast<std::size_t>(level)] = {need.tables, need.temporary, decode::beyond_limits(need, level, limits)};
  }
}

}  // namespace

FileCheck check_file(std::span<const std::byte> bytes, const DecodeLimits& limits, bool allow_prefix) {
  FileCheck found;
  found.bytes = bytes.size();
  try {
    check(bytes, limits, allow_prefix, found);
  } catch (const Error& e) {
    found.problem = e;
  }
  return found;
}

}  // namespace brdf

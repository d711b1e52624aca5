// SPDX-License-Identifier: Apache-2.0
// Runs a BRDF over the query set, in chunks that do not depend on the number of threads.
#pragma once

#include "metrics/queries.h"

#include <brdf/metrics.h>

#include <functional>
#include <span>

namespace brdf::metrics {

enum class RowKind : std::uint8_t { image, pair, albedo };

/// Consecutive rows of one kind. No pixel is split between chunks, and an albedo angle is one chunk of its own, so that
/// whoever takes a chunk may add without a lock and the sums are the same for any number of threads.
struct RowChunk {
  RowKind kind = RowKind::image;
  std::size_t first = 0, count = 0;
};
std::vector<RowChunk> make_chunks(const QuerySet& set);

struct RowCounts {
  std::uint64_t not_finite = 0, negative = 0;
};

/// Evaluates every chunk on up to `threads` threads and passes its values, `channels` per row, to `take` on the same
/// thread. Values that are not finite are counted and replaced by 0, negative ones are only counted. An exception of
/// `f` ends the work and is rethrown here.
RowCounts evaluate_rows(const QuerySet& set, std::span<const RowChunk> chunks, const BatchEval& f, int channels,
                        int threads, const std::function<void(const RowChunk&, std::span<float>)>& take);

}  // namespace brdf::metrics

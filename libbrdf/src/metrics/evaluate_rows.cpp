// SPDX-License-Identifier: Apache-2.0
#include "metrics/evaluate_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

namespace brdf::metrics {
namespace {

constexpr std::size_t chunk_rows = 4096;  // values of three channels stay in the inner caches

RowCounts repair(std::span<float> values, std::size_t channels) noexcept {
  RowCounts counts;
  for (std::size_t row = 0; row < values.size(); row += channels) {
    bool bad = false, negative = false;
    for (float& v : values.subspan(row, channels)) {
      negative |= v < 0;
      if (std::isfinite(v)) continue;
      bad = true;
      v = 0;
    }
    counts.not_finite += bad;
    counts.negative += negative;
  }
  return counts;
}

}  // namespace

std::vector<RowChunk> make_chunks(const QuerySet& set) {
  std::vector<RowChunk> chunks;
  for (const ImageRows& image : set.image) {
    const std::size_t end = image.first + image.rows;
    for (std::size_t at = image.first; at < end;) {
      std::size_t stop = std::min(at + chunk_rows, end);
      // a pixel has a few hundred rows at most, so stepping back to its first row leaves a chunk that is not empty
      while (stop < end && stop > at + 1 && set.pixel[stop] == set.pixel[stop - 1]) --stop;
      chunks.push_back({RowKind::image, at, stop - at});
      at = stop;
    }
  }
  for (std::size_t at = 0; at < set.pairs; at += chunk_rows)
    chunks.push_back({RowKind::pair, set.first_pair + at, std::min(chunk_rows, set.pairs - at)});
  for (std::size_t k = 0; k + 1 < set.albedo_begin.size(); ++k)
    chunks.push_back({RowKind::albedo, set.albedo_begin[k], set.albedo_begin[k + 1] - set.albedo_begin[k]});
  return chunks;
}

RowCounts evaluate_rows(const QuerySet& set, std::span<const RowChunk> chunks, const BatchEval& f, int channels,
                        int threads, const std::function<void(const RowChunk&, std::span<float>)>& take) {
  const auto n = static_cast<std::size_t>(channels);
  std::atomic<std::size_t> next{0};
  std::atomic<std::uint64_t> not_finite{0}, negative{0};
  std::mutex guard;
  std::exception_ptr failure;

  const auto work = [&]() noexcept {
    try {
      std::vector<float> buffer;
      for (std::size_t k = next++; k < chunks.size(); k = next++) {
        const RowChunk& chunk = chunks[k];
        buffer.assign(chunk.count * n, 0.0f);
        f(std::span(set.wi).subspan(chunk.first, chunk.count), std::span(set.wo).subspan(chunk.first, chunk.count),
          buffer);
        const RowCounts counts = repair(buffer, n);
        not_finite += counts.not_finite;
        negative += counts.negative;
        take(chunk, buffer);
      }
    } catch (...) {
      next = chunks.size();
      const std::scoped_lock lock(guard);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    const auto count = std::min(static_cast<std::size_t>(threads), chunks.size());
    for (std::size_t t = 1; t < count; ++t) helpers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return {not_finite, negative};
}

}  // namespace brdf::metrics

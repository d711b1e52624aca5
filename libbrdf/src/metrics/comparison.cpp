// SPDX-License-Identifier: Apache-2.0
#include <brdf/error.h>
#include <brdf/metrics.h>

#include "metrics/albedo.h"
#include "metrics/evaluate_rows.h"
#include "metrics/pair_errors.h"
#include "metrics/sphere_images.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brdf {
namespace {

void require(bool ok, const std::string& sentence) {
  if (!ok) throw Error(ErrorCode::invalid_argument, sentence);
}

}  // namespace

/// The reference's answers, reduced to what a score needs.
struct Comparison::State {
  int channels, threads;
  metrics::QuerySet set;
  std::vector<metrics::RowChunk> chunks;
  metrics::SphereImages images;
  metrics::Albedos albedos;
  std::vector<float> pair_values;  ///< f cos_i, not negative

  State(int channel_count, double quality, int thread_count)
      : channels(channel_count),
        threads(thread_count),
        set(metrics::build_queries(quality)),
        chunks(metrics::make_chunks(set)),
        images(set, channel_count),
        albedos(channel_count),
        pair_values(set.pairs * static_cast<std::size_t>(channel_count)) {}

  /// Position of a chunk of pairs in pair_values.
  std::size_t offset(const metrics::RowChunk& chunk) const noexcept {
    return (chunk.first - set.first_pair) * static_cast<std::size_t>(channels);
  }
};

Comparison::Comparison(const BatchEval& reference, int channels, double quality, int threads) {
  require(static_cast<bool>(reference), "comparison: the reference is an empty function, wanted a callable one");
  require(channels >= 1, "comparison: channels is " + std::to_string(channels) + ", allowed is 1 or more");
  require(quality > 0 && quality <= 1,
          "comparison: quality is " + std::to_string(quality) + ", allowed is above 0, up to 1");
  require(threads >= 1, "comparison: threads is " + std::to_string(threads) + ", allowed is 1 or more");
  state_ = std::make_unique<State>(channels, quality, threads);
  State& s = *state_;
  metrics::evaluate_rows(
      s.set, s.chunks, reference, channels, threads, [&s](const metrics::RowChunk& chunk, std::span<float> f) {
        switch (chunk.kind) {
          case metrics::RowKind::image: s.images.add(s.set, chunk.first, chunk.count, f); break;
          case metrics::RowKind::albedo: s.albedos.add(s.set, chunk.first, chunk.count, f); break;
          case metrics::RowKind::pair:
            metrics::to_cosine_weighted(s.set, chunk.first, chunk.count, s.channels, f.data());
            std::copy(f.begin(), f.end(), s.pair_values.begin() + static_cast<std::ptrdiff_t>(s.offset(chunk)));
            break;
        }
      });
}

Comparison::~Comparison() = default;
Comparison::Comparison(Comparison&&) noexcept = default;
Comparison& Comparison::operator=(Comparison&&) noexcept = default;

ErrorReport Comparison::score(const BatchEval& candidate) const {
  require(static_cast<bool>(candidate), "comparison: the candidate is an empty function, wanted a callable one");
  const State& s = *state_;
  metrics::SphereImages images(s.set, s.channels);
  metrics::Albedos albedos(s.channels);
  metrics::PairErrors errors(s.set.pairs);
  const metrics::RowCounts counts = metrics::evaluate_rows(
      s.set, s.chunks, candidate, s.channels, s.threads, [&](const metrics::RowChunk& chunk, std::span<float> f) {
        switch (chunk.kind) {
          case metrics::RowKind::image: images.add(s.set, chunk.first, chunk.count, f); break;
          case metrics::RowKind::albedo: albedos.add(s.set, chunk.first, chunk.count, f); break;
          case metrics::RowKind::pair:
            metrics::to_cosine_weighted(s.set, chunk.first, chunk.count, s.channels, f.data());
            errors.compare(chunk.first - s.set.first_pair, chunk.count, s.channels,
                           std::span(s.pair_values).subspan(s.offset(chunk), f.size()), f);
            break;
        }
      });

  ErrorReport report;
  errors.summarize(s.set, report);
  report.psnr_env = metrics::psnr(s.images.pixels[0], images.pixels[0]);
  for (std::size_t k = 0; k < report.psnr_light.size(); ++k) {
    report.psnr_light[k] = metrics::psnr(s.images.pixels[k + 1], images.pixels[k + 1]);
    report.psnr_lights += report.psnr_light[k] / static_cast<double>(report.psnr_light.size());
  }
  report.albedo_error = s.albedos.largest_difference(albedos);
  report.not_finite = counts.not_finite;
  report.negative = counts.negative;
  return report;
}

}  // namespace brdf

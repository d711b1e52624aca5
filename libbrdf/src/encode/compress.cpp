// SPDX-License-Identifier: Apache-2.0
#include "container/chunk_types.h"
#include "container/header.h"
#include "container/lobe_codes.h"
#include "encode/basis_choice.h"
#include "encode/candidate.h"
#include "encode/effort.h"
#include "encode/error_search.h"
#include "encode/size_search.h"
#include "encode/verification.h"

#include <brdf/encode.h>
#include <brdf/error.h>

#include <chrono>
#include <cstdio>

namespace brdf {
namespace {

using encode::Candidate;
using encode::Encoded;
using encode::EffortStep;

/// Size of a file when nobody says otherwise: past it most materials gain little that an eye could see.
constexpr std::uint64_t usual_size = 2048;

class Stages {
 public:
  explicit Stages(const Progress& progress) : progress_(progress) {}
  void at(const char* stage, double done) const {
    if (progress_ && !progress_(stage, done)) throw Error(ErrorCode::cancelled, "compression was cancelled");
  }

 private:
  const Progress& progress_;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool is_reciprocal(const Measurement& m, SymmetryMode mode) {
  if (mode == SymmetryMode::enforce) return true;
  const auto* table = std::get_if<HalfDifferenceTable>(&m.table);
  return table != nullptr && !table->full_circle;  // half a circle of phi_d is all that such a table has
}

FitOptions fit_options(const EffortStep& effort, int threads) {
  FitOptions o;
  o.max_lobes = effort.max_lobes;
  o.starts = effort.starts;
  o.samples = effort.fit_samples;
  o.max_iterations = effort.fit_iterations;
  o.threads = threads;
  return o;
}

/// Measures every refinement at its levels and writes the figures into the content.
void record_errors(Encoded& e, const encode::Verification& verification) {
  DecodeOptions decode;
  decode.allow_prefix = true;
  decode.sampling = false;
  const std::vector<std::uint64_t> ends = container::boundaries(e.bytes, decode.limits);
  e.content.errors.clear();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::span<const std::byte> prefix = std::span(e.bytes).first(ends[i]);
    const auto record = [&](EvalLevel level) {
      decode.level = level;
      const ErrorReport r = verification.score(Material::decode(prefix, decode));
      e.content.errors.push_back({static_cast<int>(i), level, r.log_mae.all, r.psnr_env});
    };
    if (i == 0) {
      record(EvalLevel::fast);
    } else {
      record(EvalLevel::balanced);
      record(EvalLevel::exact);
    }
  }
  e.bytes = container::pack(e.content);
}

void count_bytes(std::span<const std::byte> bytes, EncodeSummary& summary) {
  const container::Header header = container::read_header(bytes, DecodeLimits{});
  summary.bytes = bytes.size();
  summary.overhead_bytes = header.header_bytes;
  for (const container::DirectoryEntry& e : header.directory) {
    summary.overhead_bytes += container::checksum_bytes;
    switch (static_cast<container::ChunkType>(e.code)) {
      case container::ChunkType::lobes: summary.lobe_bytes += e.length; break;
      case container::ChunkType::residual:
      case container::ChunkType::refinement: summary.residual_bytes += e.length; break;
      case container::ChunkType::provenance: break;
    }
  }
}

}  // namespace

bool EncodeOptions::is_valid(std::string* why) const {
  const auto no = [&](std::string sentence) {
    if (why != nullptr) *why = std::move(sentence);
    return false;
  };
  if (effort < 0 || effort > 100) return no("effort is " + std::to_string(effort) + ", allowed are 0 to 100");
  if (threads < 1 || threads > 1024) return no("threads is " + std::to_string(threads) + ", allowed are 1 to 1024");
  if (target_size && target_error) return no("a target size and a target error exclude each other");
  if (target_error && !(target_error->value >= 0)) return no("the target error must be a number of at least 0");
  return true;
}

std::string EncodeSummary::brief() const {
  char text[200];
  std::snprintf(text, sizeof text, "%llu bytes: %d lobe%s in %llu, %d coefficients in %llu, %d refinement%s",
                static_cast<unsigned long long>(bytes), lobes, lobes == 1 ? "" : "s",
                static_cast<unsigned long long>(lobe_bytes), coefficients, static_cast<unsigned long long>(residual_bytes),
                refinements, refinements == 1 ? "" : "s");
  return text;
}

EncodeResult compress(const Measurement& m, const EncodeOptions& options, const Progress& progress) {
  std::string why;
  if (!options.is_valid(&why)) throw Error(ErrorCode::invalid_argument, "compress: " + why);
  const Stages stages(progress);
  const EffortStep& effort = encode::effort_step(options.effort);
  using Clock = std::chrono::steady_clock;
  EncodeResult result;
  EncodeSummary& summary = result.summary;

  stages.at("fit", 0.0);
  auto start = Clock::now();
  FitResult fit = fit_lobes(m, fit_options(effort, options.threads), [&](std::string_view stage, double done) {
    return !progress || progress(stage, 0.35 * done);
  });
  const LobeSet lobes = container::quantise_lobes(fit.lobes);
  summary.fit = std::move(fit.summary);
  summary.seconds_fit = seconds_since(start);

  stages.at("residual", 0.35);
  start = Clock::now();
  const bool reciprocal = is_reciprocal(m, options.reciprocity);
  const container::Content frame = encode::frame_of(m, lobes, options.store_provenance);
  Encoded best = encode::lobes_only(frame);
  const std::uint64_t lobe_file = best.bytes.size();
  const std::uint64_t size = options.target_size.value_or(usual_size);
  metrics::QuerySet queries;
  if (effort.image_quality > 0) queries = metrics::build_queries(effort.image_quality);
  const double epsilon = encode::residual_epsilon(m);
  std::optional<encode::Verification> verification;

  if (options.target_error) {
    verification.emplace(m, effort.verify_quality, options.threads);
    best = encode::encode_to_error(m, frame, encode::basis_variants(lobes, epsilon, 1).front(), reciprocal, effort, queries,
                                   *options.target_error, options.level, *verification);
  } else if (lobe_file > size) {
    // fewer lobes may still fit
    FitOptions one = fit_options(effort, options.threads);
    one.max_lobes = 1;
    FitResult smaller = fit_lobes(m, one);
    best = encode::lobes_only(encode::frame_of(m, container::quantise_lobes(smaller.lobes), options.store_provenance));
    if (best.bytes.size() > size)
      throw Error(ErrorCode::target_not_met, "compress: " + std::to_string(size) + " bytes cannot hold this material, the smallest file has " +
                                                 std::to_string(best.bytes.size()) + " bytes");
    summary.fit = std::move(smaller.summary);
  } else {
    const encode::SearchSpace space{m,      frame,   encode::basis_variants(lobes, epsilon, effort.variants), reciprocal,
                                    effort, queries, options.threads};
    Encoded found = encode::encode_to_size(space, size, [&](double share) { stages.at("residual", 0.35 + 0.5 * share); });
    if (!found.bytes.empty()) best = std::move(found);
  }
  summary.seconds_residual = seconds_since(start);

  stages.at("verify", 0.85);
  start = Clock::now();
  if (!verification) verification.emplace(m, effort.verify_quality, options.threads);
  record_errors(best, *verification);
  summary.seconds_verify = seconds_since(start);

  count_bytes(best.bytes, summary);
  summary.lobes = static_cast<int>(best.content.lobes.lobes.size());
  summary.refinements = static_cast<int>(best.content.residual.layers.size());
  for (const residual::Layer& layer : best.content.residual.layers)
    for (const auto& q : layer.q)
      for (const std::int32_t v : q) summary.coefficients += v != 0 ? 1 : 0;
  summary.reciprocal = best.content.component.reciprocal;
  summary.errors = best.content.errors;
  result.bytes = std::move(best.bytes);
  stages.at("done", 1.0);
  return result;
}

}  // namespace brdf

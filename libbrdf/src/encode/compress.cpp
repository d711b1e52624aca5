// SPDX-License-Identifier: Apache-2.0
#include "container/chunk_types.h"
#include "container/header.h"
#include "container/lobe_codes.h"
#include "encode/asymmetry.h"
#include "encode/basis_choice.h"
#include "encode/candidate.h"
#include "encode/effort.h"
#include "encode/energy.h"
#include "encode/error_search.h"
#include "encode/file_errors.h"
#include "encode/lobe_energy.h"
#include "encode/purpose.h"
#include "encode/query_weight.h"
#include "encode/size_search.h"
#include "encode/stored_cdf.h"
#include "encode/verification.h"

#include <brdf/encode.h>
#include <brdf/error.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace brdf {
namespace {

using encode::Candidate;
using encode::Encoded;
using encode::EffortStep;

/// Size of a file when nobody says otherwise: past it most materials gain little that an eye could see.
constexpr std::uint64_t usual_size = 2048;
constexpr std::uint64_t few_bytes = 160;       // below, lobes and residual compete for the same bytes
constexpr int more_lobes = 1;                  // than the effort has, where they may be all that a file holds
constexpr double asymmetry_quality = 0.05;
constexpr double choosing_quality = 0.3;       // of the verification that tells candidates apart

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

FitOptions fit_options(const EffortStep& effort, int threads) {
  FitOptions o;
  o.max_lobes = effort.max_lobes;
  o.starts = effort.starts;
  o.samples = effort.fit_samples;
  o.max_iterations = effort.fit_iterations;
  o.threads = threads;
  return o;
}

/// Readers mask what is no number, but a measurement may come from elsewhere.
void check_values(const Measurement& m) {
  const auto* cells = std::get_if<HalfDifferenceTable>(&m.table);
  const std::vector<float>& values = cells != nullptr ? cells->values : std::get<VisibleNormalTable>(m.table).values;
  const auto channels = static_cast<std::size_t>(std::max(m.channels.count, 1));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) && (cells == nullptr || (i / channels < cells->valid.size() && cells->valid[i / channels] != 0)))
      throw Error(ErrorCode::invalid_argument, "compress: value " + std::to_string(i) + " of the measurement is not finite, and its cell is valid");
}

/// What the search for this file lowered; larger is better.
encode::Worth worth_of(const EncodeOptions& options) {
  if (!options.target_error) return encode::merit;
  return [metric = options.target_error->metric](const ErrorReport& r) {
    const bool decibels = metric == Metric::psnr_env || metric == Metric::psnr_lights;
    return decibels ? r.get(metric) : -r.get(metric);
  };
}

void count_bytes(std::span<const std::byte> bytes, EncodeSummary& summary) {
  const container::Header header = container::read_header(bytes, DecodeLimits{});
  summary.bytes = bytes.size();
  summary.overhead_bytes = header.header_bytes;
  for (const container::DirectoryEntry& e : header.directory) {
    summary.overhead_bytes += container::checksum_bytes;
    switch (static_cast<container::ChunkType>(e.code)) {
      case container::ChunkType::packed_lobes:
      case container::ChunkType::lobes: summary.lobe_bytes += e.length; break;
      case container::ChunkType::residual:
      case container::ChunkType::refinement: summary.residual_bytes += e.length; break;
      case container::ChunkType::sampling: summary.cdf_bytes += e.length; break;
      case container::ChunkType::analytic:  // compress writes none
      case container::ChunkType::purpose:
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
  if (target_error && target_error->metric == Metric::profile && !profile) return no("a target error under a profile needs a profile");
  if (!(profile_share >= 0 && profile_share <= 1)) return no("the profile's share is " + std::to_string(profile_share) + ", allowed are 0 to 1");
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

namespace {

EncodeResult compress_without_cdf(const Measurement& m, const EncodeOptions& options, const Progress& progress) {
  std::string why;
  if (!options.is_valid(&why)) throw Error(ErrorCode::invalid_argument, "compress: " + why);
  check_values(m);
  const Stages stages(progress);
  const EffortStep& effort = encode::effort_step(options.effort);
  using Clock = std::chrono::steady_clock;
  EncodeResult result;
  EncodeSummary& summary = result.summary;

  const std::uint64_t size = options.target_size.value_or(usual_size);
  stages.at("fit", 0.0);
  auto start = Clock::now();
  FitOptions lobe_options = fit_options(effort, options.threads);
  if (size < few_bytes) lobe_options.max_lobes += more_lobes;
  const MaterialProfile* const asked = options.profile.get();
  // the usual weights have their say under a profile, too: the error model is an approximation, and the best measured file wins
  const std::vector<encode::QueryWeight> asked_weights = encode::query_weights(m, asked, effort);
  std::vector<const encode::QueryWeight*> weights;
  for (const encode::QueryWeight& w : asked_weights) weights.push_back(&w);
  weights.push_back(nullptr);
  FitResult fit = encode::fit_asked(m, lobe_options, weights.front(), [&](std::string_view stage, double done) {
    return !progress || progress(stage, 0.35 * done);
  });
  summary.seconds_fit = seconds_since(start);

  stages.at("residual", 0.35);
  start = Clock::now();
  std::size_t run = 0;  // of the weights
  const auto progress_of_search = [&](double share) {
    stages.at("residual", 0.35 + 0.5 * (static_cast<double>(run) + share) / static_cast<double>(weights.size()));
  };
  const double epsilon = encode::residual_epsilon(m);
  const encode::Asymmetry asymmetry = encode::measure_asymmetry(m, std::min(asymmetry_quality, effort.verify_quality));
  const encode::Azimuths azimuths = encode::azimuths(m, options.reciprocity, options.mirror, asymmetry, effort);
  // one verification tells candidates apart, a finer one has the last word; where they are the same they are one
  const double final_quality = options.target_error ? 1.0 : effort.verify_quality, coarse_quality = std::min(choosing_quality, effort.verify_quality);
  const encode::Verification verification(m, final_quality, options.threads, asked);
  std::optional<encode::Verification> coarse;
  if (coarse_quality < final_quality) coarse.emplace(m, coarse_quality, options.threads, asked);
  const encode::Verification& choosing = coarse ? *coarse : verification;
  const double bound = options.energy == EnergyMode::clamp ? 1 : encode::unasked_energy;  // under a profile
  const double energy_limit =
      asked != nullptr ? bound * std::max(1.0, encode::largest_albedo(m, Material::from_lobes(fit.lobes).prepare(EvalLevel::fast, true))) : 0;
  const auto frame_for = [&](const FitResult& f) {
    LobeSet lobes = f.lobes;
    if (asked != nullptr) encode::bound_lobes(lobes, energy_limit);  // of what nobody asked the fit knows little
    container::Content frame = encode::frame_of(m, container::quantise_lobes(lobes), epsilon, options.store_provenance);
    if (asked != nullptr) frame.purpose = encode::purpose_of(options);
    return frame;
  };
  const auto search_for = [&](const container::Content& frame, const EffortStep& step, const encode::Verification& telling_apart, const auto& use) {
    const std::vector<residual::BasisCodes> bases = encode::basis_variants(frame.lobes, epsilon, step.variants);
    const encode::SourceData source(m, frame, step, weights[run]);
    return use(source, encode::Search{bases, azimuths, options.level, telling_apart, options.threads, step.effort == effort.effort});
  };

  Encoded best;
  // what hardly matters to a scene may need fewer lobes than the data require
  const auto try_fewer_lobes = [&] {
    for (int lobes = 1; lobes < static_cast<int>(best.content.lobes.lobes.size()) || (lobes == 1 && !best.content.residual.empty()); ++lobes) {
      FitOptions few = lobe_options;
      few.max_lobes = lobes;
      FitResult smaller = encode::fit_asked(m, few, weights.front());
      Encoded e = encode::lobes_only(frame_for(smaller));
      if (e.bytes.size() >= best.bytes.size() || !verification.score(e.bytes, options.level).meets(*options.target_error)) continue;
      best = std::move(e);
      summary.fit = std::move(smaller.summary);
      return;
    }
  };
  double reciprocity_gain = 0, mirror_gain = 0;  // dB of keeping the asymmetry
  if (options.target_error) {
    std::optional<Error> unmet;
    const auto try_step = [&](const EffortStep& step, FitResult lobes, const encode::Verification& telling_apart) {
      try {
        Encoded e = search_for(frame_for(lobes), step, telling_apart, [&](const encode::SourceData& source, const encode::Search& search) {
          return encode::encode_to_error(source, search, *options.target_error, verification, progress_of_search);
        });
        if (!best.bytes.empty() && e.bytes.size() >= best.bytes.size()) return;
        best = std::move(e);
        summary.fit = std::move(lobes.summary);
      } catch (const Error& e) {
        if (e.code() != ErrorCode::target_not_met) throw;
        unmet = e;
      }
    };
    // every lower step has its say, so that more effort is never a larger file
    for (const EffortStep& step : encode::effort_steps()) {
      if (step.effort >= effort.effort) break;
      const encode::Verification own(m, std::min(choosing_quality, step.verify_quality), options.threads, asked);
      try_step(step, encode::fit_asked(m, fit_options(step, options.threads), weights.front()), own);
    }
    for (run = 0; run < weights.size(); ++run)
      try_step(effort, run == 0 ? std::move(fit) : encode::fit_asked(m, fit_options(effort, options.threads), weights[run]), choosing);
    if (best.bytes.empty()) throw *unmet;
    if (asked != nullptr) try_fewer_lobes();
  } else {
    double merit = 0;
    std::uint64_t smallest = UINT64_MAX;
    const auto try_lobes = [&](FitResult& lobes, const container::Content& frame) {
      const std::uint64_t alone = encode::lobes_only(frame).bytes.size();
      smallest = std::min(smallest, alone);
      if (alone > size) return;
      encode::Found found = search_for(frame, effort, choosing, [&](const encode::SourceData& source, const encode::Search& search) {
        return encode::encode_to_size(source, search, size, progress_of_search);
      });
      if (!best.bytes.empty() && found.merit <= merit) return;
      merit = found.merit;
      reciprocity_gain = found.gain(residual::Azimuth::one_way, residual::Azimuth::symmetric);
      mirror_gain = found.gain(residual::Azimuth::reciprocal, residual::Azimuth::symmetric);
      best = std::move(found.file);
      summary.fit = std::move(lobes.summary);
    };
    for (run = 0; run < weights.size(); ++run) {
      FitOptions lobe_limits = lobe_options;
      if (run > 0) fit = encode::fit_asked(m, lobe_limits, weights[run]);
      // in a small file one lobe less may leave room for something better
      for (;;) {
        const container::Content frame = frame_for(fit);
        try_lobes(fit, frame);
        const int fewer = static_cast<int>(frame.lobes.lobes.size()) - 1;
        if (size >= few_bytes || fewer < 1) break;
        lobe_limits.max_lobes = fewer;
        fit = encode::fit_asked(m, lobe_limits, weights[run]);
      }
    }
    if (best.bytes.empty())
      throw Error(ErrorCode::target_not_met, "compress: " + std::to_string(size) + " bytes cannot hold this material, the smallest file has " +
                                                 std::to_string(smallest) + " bytes");
  }
  summary.seconds_residual = seconds_since(start);

  stages.at("verify", 0.85);
  start = Clock::now();
  const auto finish = [&](Encoded& e) { encode::record_errors(e, verification, options.level, worth_of(options)); };
  finish(best);
  summary.source_albedo = encode::largest_albedo(m, Material::decode(best.bytes));
  const encode::ClampedEnergy energy =
      options.energy == EnergyMode::clamp || asked != nullptr
          ? encode::clamp_energy(best, (asked != nullptr ? bound : 1.0) * std::max(1.0, summary.source_albedo) + encode::energy_tolerance,
                                 options.target_size.value_or(UINT64_MAX), finish)
          : encode::ClampedEnergy{1, encode::largest_albedo(best.bytes)};
  summary.energy_scale = energy.scale;
  summary.largest_albedo = energy.albedo.value;
  summary.energy = encode::energy_sentence(options.energy, energy.albedo, summary.source_albedo, energy.scale);
  if (asked != nullptr) summary.profile = encode::record_purpose(best, verification, options);
  summary.seconds_verify = seconds_since(start);

  count_bytes(best.bytes, summary);
  summary.lobes = static_cast<int>(best.content.lobes.lobes.size());
  summary.refinements = static_cast<int>(best.content.residual.layers.size());
  for (const residual::Layer& layer : best.content.residual.layers)
    for (const auto& q : layer.q)
      for (const std::int32_t v : q) summary.coefficients += v != 0 ? 1 : 0;
  summary.reciprocal = best.content.component.reciprocal;
  summary.reciprocity_asymmetry = asymmetry.reciprocity;
  summary.mirror_asymmetry = asymmetry.mirror;
  summary.reciprocity = encode::reciprocity_sentence(options.reciprocity, asymmetry.reciprocity == 0, summary.reciprocal,
                                                     summary.refinements == 0, asymmetry.reciprocity, reciprocity_gain);
  summary.mirror = encode::mirror_sentence(options.mirror, !best.content.component.mirror_symmetric, summary.refinements == 0, asymmetry.mirror, mirror_gain);
  summary.errors = best.content.errors;
  result.bytes = std::move(best.bytes);
  stages.at("done", 1.0);
  return result;
}

}  // namespace

EncodeResult compress(const Measurement& m, const EncodeOptions& options, const Progress& progress) {
  // nobody draws directions from what is never sampled
  const bool never_sampled = options.profile && !options.profile->asked(ProfileOperation::sample) && !options.profile->asked(ProfileOperation::pdf);
  if (!options.store_cdf || never_sampled) {
    EncodeResult result = compress_without_cdf(m, options, progress);
    if (options.store_cdf) result.summary.left_out = "the sampling tables are left out: the profile has no sample and no pdf";
    return result;
  }
  constexpr int most_attempts = 4;
  EncodeOptions rest = options;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    EncodeResult result = compress_without_cdf(m, rest, progress);
    const std::uint64_t without = result.bytes.size();
    result.bytes = encode::with_stored_cdf(result.bytes, options.level);
    const std::uint64_t whole = result.bytes.size();
    if (!options.target_size || whole <= *options.target_size) {
      result.summary.lobe_bytes = result.summary.residual_bytes = 0;
      count_bytes(result.bytes, result.summary);
      return result;
    }
    // the tables of a smaller file are about as large
    const std::uint64_t tables = whole - without;
    if (tables + few_bytes / 2 > *options.target_size)
      throw Error(ErrorCode::target_not_met, "compress: the sampling tables of this material need " + std::to_string(tables) + " bytes, which leaves too little of " +
                                                 std::to_string(*options.target_size));
    rest.target_size = *options.target_size - tables - static_cast<std::uint64_t>(attempt) * tables / 50;
  }
  throw Error(ErrorCode::target_not_met, "compress: no file of " + std::to_string(*options.target_size) + " bytes was found that holds the sampling tables");
}

}  // namespace brdf

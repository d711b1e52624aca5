// SPDX-License-Identifier: Apache-2.0
/// @file encode.h
/// Compression: measurement in, `.brdfc` bytes and a verified error out.
#pragma once

#include <brdf/analytic.h>
#include <brdf/fit.h>
#include <brdf/material.h>
#include <brdf/measurement.h>
#include <brdf/metrics.h>
#include <brdf/progress.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brdf {

enum class SymmetryMode : std::uint8_t { automatic, keep, enforce };

/// report: say how much light comes back. clamp: scale the file down where that is more than arrives, and more than the
/// measurement has: no directional albedo exceeds max(1, the measurement's largest) by more than 0.005.
enum class EnergyMode : std::uint8_t { report, clamp };

/// A named point of the effort scale. Effort is encode time only.
struct Preset {
  std::string_view name;
  int effort;
  std::string_view purpose;
};

/// fastest, fast, medium, thorough, exhaustive. The one table that code, help and documents use.
std::span<const Preset> presets() noexcept;

/// What each step of the effort scale turns on, as a table in Markdown; docs/effort.md holds it.
std::string effort_table();

struct EncodeOptions {
  int effort = 50;                                  ///< 0 to 100
  std::optional<std::uint64_t> target_size;         ///< bytes of the whole file, never exceeded
  std::optional<ErrorTarget> target_error;          ///< verified on the decoded file at `level`
  EvalLevel level = EvalLevel::balanced;            ///< at which errors are stated
  SymmetryMode reciprocity = SymmetryMode::automatic;
  SymmetryMode mirror = SymmetryMode::automatic;
  EnergyMode energy = EnergyMode::report;
  int threads = 1;                                  ///< bytes do not depend on it
  bool store_provenance = false;                    ///< adds an optional chunk
  /// Adds an optional chunk of some kilobytes with the sampling tables of `level`: decoding reads instead of building them.
  bool store_cdf = false;
  bool is_valid(std::string* why = nullptr) const;
};

struct EncodeSummary {
  FitSummary fit;
  std::uint64_t bytes = 0;           ///< of the file: the four below and, if asked for, provenance
  std::uint64_t lobe_bytes = 0, residual_bytes = 0, overhead_bytes = 0;  ///< overhead: header, directory, checksums
  std::uint64_t cdf_bytes = 0;         ///< of the sampling tables
  int lobes = 0, refinements = 0, coefficients = 0;                      ///< coefficients that are not 0
  bool reciprocal = false;
  double reciprocity_asymmetry = 0, mirror_asymmetry = 0;  ///< of the measurement: log_mae against its symmetric average
  std::string reciprocity, mirror;     ///< what became of each, one sentence
  double largest_albedo = 0, source_albedo = 0;  ///< of any channel at any level, of the measurement; wo to 85 degrees
  double energy_scale = 1;             ///< below 1: what EnergyMode::clamp multiplied f by
  std::string energy;                  ///< one sentence
  std::vector<RecordedError> errors;   ///< of the finished file
  double seconds_fit = 0, seconds_residual = 0, seconds_verify = 0;
  std::string brief() const;
};

struct EncodeResult {
  std::vector<std::byte> bytes;
  EncodeSummary summary;
};

/// Compresses. Values of valid cells must be finite. Throws Error: invalid_argument, no_data, cancelled, target_not_met
/// (its sentence says the best reachable value). Deterministic for any number of threads and any instruction set.
EncodeResult compress(const Measurement& m, const EncodeOptions& options = {}, const Progress& progress = {});

/// The bytes of a `.brdfc` file that holds the parameters of a model as they are: 22 bytes and the parameters, and the
/// provenance if given. `channels` says what the channels mean; without, three are RGB and one is a scalar. Deterministic.
/// Throws Error(invalid_argument).
std::vector<std::byte> pack_analytic(const AnalyticModel& model, const Provenance* provenance = nullptr,
                                     const Channels* channels = nullptr);

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
// Everything that `bench` measures of one material, compressed once, at one level; or of a peer of it.
#pragma once

#include <brdf/material.h>
#include <brdf/metrics.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace brdf::cli {

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Nanoseconds are per query, of batches of 4096 unless scalar, on one thread. A peer has no preset of ours, and what it
/// cannot do is not_measured.
struct BenchRow {
  std::string material, preset;
  std::optional<int> effort;
  std::optional<std::uint64_t> target;  ///< bytes asked for
  std::optional<EvalLevel> level;
  std::uint64_t bytes = 0;
  double ratio = 0;         ///< bytes of the source file over bytes
  double ratio_native = 0;  ///< float32 numbers that the source really holds over bytes
  double encode_s = not_measured, decode_us = not_measured;
  std::uint64_t resident_bytes = 0;
  double eval_ns = not_measured, eval_ns_scalar = not_measured;
  double pdf_ns = not_measured, pdf_ns_scalar = not_measured;
  double sample_ns = not_measured, sample_ns_scalar = not_measured;      ///< with pdf and weight
  double raw_eval_ns = not_measured, raw_eval_ns_scalar = not_measured;  ///< of the measured table, see peers/raw_table.h
  ErrorReport errors;
  std::string simd;
  int threads = 1;  ///< of the encoder
  int bugs = 0;     ///< failed checks of the round trip
};

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
// Everything that `bench` measures of one material, compressed once, at one level.
#pragma once

#include <brdf/material.h>
#include <brdf/metrics.h>

#include <cstdint>
#include <optional>
#include <string>

namespace brdf::cli {

/// Nanoseconds are per query, of batches of 4096 unless scalar, on one thread.
struct BenchRow {
  std::string material, preset;
  int effort = 0;
  std::optional<std::uint64_t> target;  ///< bytes asked for
  EvalLevel level = EvalLevel::balanced;
  std::uint64_t bytes = 0;
  double ratio = 0;         ///< bytes of the source file over bytes
  double ratio_native = 0;  ///< float32 numbers that the source really holds over bytes
  double encode_s = 0, decode_us = 0;
  std::uint64_t resident_bytes = 0;
  double eval_ns = 0, eval_ns_scalar = 0, pdf_ns = 0;
  double sample_ns = 0, sample_ns_scalar = 0;      ///< with pdf and weight
  double raw_eval_ns = 0, raw_eval_ns_scalar = 0;  ///< of the interpolated table
  ErrorReport errors;
  std::string simd;
  int threads = 1;  ///< of the encoder
  int bugs = 0;     ///< failed checks of the round trip
};

}  // namespace brdf::cli

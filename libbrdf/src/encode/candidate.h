// SPDX-License-Identifier: Apache-2.0
// One way to write a material: lobes and a basis, with the error model that belongs to them.
#pragma once

#include "container/content.h"
#include "encode/effort.h"
#include "encode/error_model.h"
#include "encode/quantiser.h"

#include <cstdint>
#include <vector>

namespace brdf::encode {

/// Bytes of a file and how it came about.
struct Encoded {
  container::Content content;
  std::vector<std::byte> bytes;
  double error = 0;   ///< of the error model
  int step_code = 0;
};

class Candidate {
 public:
  /// `frame`: all that a file says but its residual.
  Candidate(const Measurement& m, const container::Content& frame, const residual::BasisCodes& basis, bool reciprocal,
            const EffortStep& effort, const metrics::QuerySet& queries);

  /// Quantised with one step.
  Encoded encode(int step_code, double lambda_scale, int layers) const;

  /// The file with the smallest error of at most `bytes` (its layers included); empty bytes when even the coarsest
  /// step is larger.
  Encoded encode_to_size(std::uint64_t bytes) const;

 private:
  container::Content frame_;
  residual::BasisCodes basis_;
  bool reciprocal_;
  int passes_;
  ErrorModel model_;
  std::vector<std::vector<double>> start_;
};

/// All that a file says but its residual; `store_provenance` adds where it comes from.
container::Content frame_of(const Measurement& m, const LobeSet& lobes, bool store_provenance);

/// The file without any residual.
Encoded lobes_only(const container::Content& frame);

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
// One way to write a material: lobes and a basis, with the error model that belongs to them.
#pragma once

#include "container/content.h"
#include "encode/error_model.h"
#include "encode/quantiser.h"
#include "encode/source_data.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace brdf::encode {

/// Bytes of a file and how it came about.
struct Encoded {
  container::Content content;
  std::vector<std::byte> bytes;
  double error = 0;   ///< of the error model
  int step_code = 0;
  double lambda_scale = 1;
};

/// What a file of at most `bytes` has at least, unless no further byte lowers the error.
inline std::uint64_t least_size(std::uint64_t bytes) noexcept { return bytes - std::min(bytes, std::max<std::uint64_t>(bytes / 50, 8)); }

class Candidate {
 public:
  /// In half/difference coordinates.
  static Candidate half_difference(const SourceData& source, const residual::BasisCodes& basis, residual::Azimuth azimuth, int coefficients);

  /// How a residual in slices is set up.
  struct SliceSettings {
    int ndf_step = 8;          ///< the ndf is rounded to steps of 2^-(ndf_step / 2) octaves
    int shape = 4;             ///< order of the coefficients
    int coefficients = 2000;   ///< beyond largest_matrix the error model keeps only its diagonal
  };
  static constexpr int largest_matrix = 4096;

  /// In the measurement's own slices; none for measurements that have none. `basis` is that of the balanced table.
  static std::optional<Candidate> in_slices(const SourceData& source, const residual::BasisCodes& basis, const SliceSettings& settings);

  /// Quantised with one step.
  Encoded encode(int step_code, double lambda_scale, int layers) const;

  /// Files of at most `bytes` (layers included) that a search came by, by increasing error of the model. Nothing when even the
  /// coarsest step is larger.
  std::vector<Encoded> encode_to_size(std::uint64_t bytes) const;

 private:
  Candidate(container::Content frame, residual::ResidualCode code, std::vector<residual::Frequency> order, int passes)
      : frame_(std::move(frame)), code_(std::move(code)), order_(std::move(order)), passes_(passes) {}

  container::Content frame_;
  residual::ResidualCode code_;  ///< without layers
  std::vector<residual::Frequency> order_;
  int passes_;
  ErrorModel model_;
  std::vector<std::vector<double>> start_;
};

/// All that a file says but its residual; `epsilon` is that of the basis, `store_provenance` adds where the file comes from.
container::Content frame_of(const Measurement& m, const LobeSet& lobes, double epsilon, bool store_provenance);

/// The file without any residual.
Encoded lobes_only(const container::Content& frame);

}  // namespace brdf::encode

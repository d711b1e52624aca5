// SPDX-License-Identifier: Apache-2.0
// What all candidates of one material share; each part is made when it is first asked for.
#pragma once

#include "container/content.h"
#include "encode/bins.h"
#include "encode/effort.h"
#include "encode/error_model.h"
#include "encode/memo.h"
#include "encode/query_weight.h"
#include "encode/slice_samples.h"
#include "metrics/queries.h"

#include <brdf/measurement.h>

#include <optional>
#include <utility>
#include <vector>

namespace brdf::encode {

struct WeightedBins {
  Bins bins;
  std::vector<double> weights;  ///< of the cells, see distortion.h
};

/// A measurement in slices with one rounding of its ndf.
struct SliceSource {
  residual::SliceFrame frame;
  SliceSamples samples;
  std::vector<double> weights;  ///< of the nodes
};

class SourceData {
 public:
  /// All are kept by reference; `asked` may be null.
  SourceData(const Measurement& m, const container::Content& all_but_residual, const EffortStep& step, const QueryWeight* asked = nullptr)
      : measurement(m), frame(all_but_residual), effort(step), asked_(asked) {}

  const Measurement& measurement;
  const container::Content& frame;  ///< all that a file says but its residual
  const EffortStep& effort;

  const WeightedBins& bins(const residual::BasisCodes& codes) const;

  /// Share of the picture in the error model.
  double environment_weight() const noexcept;

  /// Rows and slopes of the picture in the error model; no slopes when the effort or the material has none.
  const metrics::QuerySet& queries() const;
  const ImageSlopes& image() const;

  /// Null when the measurement has no slices. Weights follow the first basis that asks: all share epsilon.
  const SliceSource* slices(int ndf_step, const residual::BasisCodes& codes) const;

 private:
  const QueryWeight* asked_;
  mutable Memo<std::pair<int, int>, WeightedBins> bins_;
  mutable Memo<int, metrics::QuerySet> queries_;
  mutable Memo<int, ImageSlopes> image_;
  mutable Memo<int, std::optional<SliceSource>> slices_;
};

}  // namespace brdf::encode

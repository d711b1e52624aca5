// SPDX-License-Identifier: Apache-2.0
#include "encode/source_data.h"

#include "encode/distortion.h"
#include "encode/slice_model.h"

namespace brdf::encode {

const WeightedBins& SourceData::bins(const residual::BasisCodes& codes) const {
  return bins_.get({codes.kappa_h, codes.kappa_d}, [&] {
    const residual::Basis basis = residual::basis_of(codes);
    WeightedBins w;
    w.bins = sample_bins(measurement, frame.lobes, basis, effort.bins_h, effort.bins_d, effort.bins_p, effort.substeps);
    w.weights = cell_weights(w.bins, basis.epsilon, {});
    if (asked_ != nullptr) asked_->blend(w.bins, basis, w.weights);
    return w;
  });
}

double SourceData::environment_weight() const noexcept { return MetricMix{}.environment * (asked_ != nullptr ? 1 - asked_->share() : 1.0); }

const metrics::QuerySet& SourceData::queries() const {
  return queries_.get(0, [&] { return effort.image_quality > 0 ? metrics::build_queries(effort.image_quality) : metrics::QuerySet{}; });
}

const ImageSlopes& SourceData::image() const {
  return image_.get(0, [&] { return effort.image_quality > 0 ? image_slopes(measurement, queries()) : ImageSlopes{}; });
}

const SliceSource* SourceData::slices(int ndf_step, const residual::BasisCodes& codes) const {
  const std::optional<SliceSource>& found = slices_.get(ndf_step, [&]() -> std::optional<SliceSource> {
    const std::optional<residual::SliceFrame> f = slice_frame(measurement, ndf_step);
    if (!f) return {};
    SliceSource s{*f, sample_slices(measurement, *f), {}};
    const WeightedBins& b = bins(codes);
    s.weights = slice_weights(b.bins, b.weights, residual::basis_of(codes), s.frame, s.samples);
    return s;
  });
  return found ? &*found : nullptr;
}

}  // namespace brdf::encode

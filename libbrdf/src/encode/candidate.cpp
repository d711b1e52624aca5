// SPDX-License-Identifier: Apache-2.0
#include "encode/candidate.h"

#include "encode/bins.h"
#include "encode/distortion.h"
#include "encode/layers.h"
#include "encode/slice_model.h"

#include <brdf/version.h>

#include <algorithm>

namespace brdf::encode {
namespace {

constexpr int finest_step = 128;  // 2^-12: below it the table's half floats round more

}  // namespace

container::Content frame_of(const Measurement& m, const LobeSet& lobes, bool store_provenance) {
  container::Content c;
  c.component.channels = m.channels;
  c.component.reciprocal = true;  // lobes are symmetric to the last bit
  c.component.transform = m.channels.count == 3 ? residual::ChannelTransform::opponent
                          : m.channels.count == 1 ? residual::ChannelTransform::identity
                                                  : residual::ChannelTransform::cosine;
  c.lobes = lobes;
  if (store_provenance) {
    c.provenance = m.provenance;
    c.fitter = std::string("libbrdf ") + version();
  }
  return c;
}

Encoded lobes_only(const container::Content& frame) {
  Encoded e;
  e.content = frame;
  e.bytes = container::pack(e.content);
  return e;
}

Candidate Candidate::half_difference(const Measurement& m, const container::Content& frame, const residual::BasisCodes& codes,
                                     bool reciprocal, const EffortStep& effort, const metrics::QuerySet& queries) {
  residual::ResidualCode code;
  code.basis = codes;
  code.reciprocal = reciprocal;
  code.channels = m.channels.count;
  Candidate c(frame, code, residual::coefficient_order(residual::order_shapes[codes.shape], reciprocal, static_cast<std::uint32_t>(effort.coefficients)),
              effort.passes);
  const residual::Basis basis = residual::basis_of(codes);
  const residual::ChannelTransform transform = frame.component.transform;
  const MetricMix mix;
  const Bins bins = sample_bins(m, frame.lobes, basis, effort.bins_h, effort.bins_d, effort.bins_p, effort.substeps);
  c.model_ = cell_model(bins, cell_weights(bins, basis.epsilon, mix), basis, c.order_, transform);
  if (effort.image_quality > 0) add_environment(c.model_, m, frame.lobes, queries, basis, c.order_, transform, mix.environment);
  c.start_ = solve_coefficients(c.model_);
  return c;
}

std::optional<Candidate> Candidate::in_slices(const Measurement& m, const container::Content& frame, const residual::BasisCodes& codes,
                                              const SliceSettings& settings, const EffortStep& effort, const metrics::QuerySet& queries) {
  std::optional<residual::SliceFrame> slices = slice_frame(m, settings.ndf_step);
  if (!slices) return {};
  residual::ResidualCode code;
  code.basis = codes;
  code.basis.shape = static_cast<std::uint8_t>(settings.shape);
  code.slices = *slices;
  code.channels = m.channels.count;
  Candidate c(frame, code, residual::coefficient_order(residual::order_shapes[settings.shape], false,
                                                       static_cast<std::uint32_t>(settings.coefficients), residual::reach_of(*slices)),
              effort.passes);
  const residual::Basis basis = residual::basis_of(codes);
  const residual::ChannelTransform transform = frame.component.transform;
  const MetricMix mix;
  const Bins bins = sample_bins(m, frame.lobes, basis, effort.bins_h, effort.bins_d, effort.bins_p, effort.substeps);
  const SliceSamples samples = sample_slices(m, *slices);
  const std::vector<double> weights = slice_weights(bins, cell_weights(bins, basis.epsilon, mix), basis, *slices, samples);
  c.start_ = slice_coefficients(samples, c.order_, transform);
  if (c.order_.size() > static_cast<std::size_t>(largest_matrix)) {
    c.model_ = slice_diagonal(samples, weights, c.order_, c.start_);
    return c;
  }
  c.model_ = slice_model(samples, weights, c.order_, transform);
  if (effort.image_quality > 0) add_environment(c.model_, m, samples, *slices, queries, c.order_, transform, mix.environment);
  return c;
}

Encoded Candidate::encode(int step_code, double lambda_scale, int layers) const {
  Encoded e;
  e.content = frame_;
  e.step_code = step_code;
  const Quantised q = quantise(model_, start_, order_, code_.reciprocal, {residual::step_of(step_code), lambda_scale, passes_});
  e.error = q.error;
  e.content.residual = make_layers(q, code_, step_code, layers);
  e.content.component.reciprocal = code_.reciprocal || e.content.residual.empty();
  e.bytes = container::pack(e.content);
  return e;
}

Encoded Candidate::encode_to_size(std::uint64_t bytes) const {
  const int layers = layer_count(bytes);
  Encoded best;
  int coarse = 0, fine = finest_step;  // the size grows with the code
  while (coarse < fine) {
    const int middle = (coarse + fine + 1) / 2;
    Encoded e = encode(middle, 1.0, layers);
    if (e.bytes.size() <= bytes) {
      coarse = middle;
      best = std::move(e);
    } else {
      fine = middle - 1;
    }
  }
  if (best.bytes.empty()) {
    best = encode(0, 1.0, layers);
    if (best.bytes.size() > bytes) best.bytes.clear();
    return best;
  }
  // spend what is left with a finer step and a steeper price, or a lower price at this step
  const auto consider = [&](Encoded e) {
    const bool fits = e.bytes.size() <= bytes;
    if (fits && e.error < best.error) best = std::move(e);
    return fits;
  };
  if (coarse < finest_step) {
    double low = 1.0, high = 4.0;
    for (int i = 0; i < 4; ++i) {
      const double scale = (low + high) / 2;
      (consider(encode(coarse + 1, scale, layers)) ? high : low) = scale;
    }
  }
  double low = 0.2, high = 1.0;
  for (int i = 0; i < 4; ++i) {
    const double scale = (low + high) / 2;
    (consider(encode(coarse, scale, layers)) ? high : low) = scale;
  }
  return best;
}

}  // namespace brdf::encode

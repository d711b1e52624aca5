// SPDX-License-Identifier: Apache-2.0
#include "encode/candidate.h"

#include "encode/bins.h"
#include "encode/distortion.h"
#include "encode/layers.h"
#include "encode/slice_model.h"
#include "encode/transform_choice.h"

#include <brdf/version.h>

#include <algorithm>
#include <cmath>

namespace brdf::encode {
namespace {

constexpr int finest_step = 128;  // 2^-12: below it the table's half floats round more

}  // namespace

container::Content frame_of(const Measurement& m, const LobeSet& lobes, double epsilon, bool store_provenance) {
  container::Content c;
  c.component.channels = m.channels;
  c.component.reciprocal = true;  // lobes are symmetric to the last bit
  c.component.transform = decorrelating_transform(m, lobes, epsilon);
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

Candidate Candidate::half_difference(const SourceData& source, const residual::BasisCodes& codes, residual::Azimuth azimuth, int coefficients) {
  residual::ResidualCode code;
  code.basis = codes;
  code.azimuth = azimuth;
  code.channels = source.measurement.channels.count;
  Candidate c(source.frame, code, residual::coefficient_order(residual::order_shapes[codes.shape], residual::even_only(azimuth), static_cast<std::uint32_t>(coefficients)),
              source.effort.passes);
  const residual::Basis basis = residual::basis_of(codes);
  const residual::ChannelTransform transform = source.frame.component.transform;
  const WeightedBins& cells = source.bins(codes);
  c.model_ = cell_model(cells.bins, cells.weights, basis, azimuth, c.order_, transform);
  if (!source.image().slope.empty())
    add_environment(c.model_, source.image(), source.frame.lobes, source.queries(), basis, azimuth, c.order_, transform, source.environment_weight());
  c.start_ = solve_coefficients(c.model_);
  return c;
}

std::optional<Candidate> Candidate::in_slices(const SourceData& source, const residual::BasisCodes& codes, const SliceSettings& settings) {
  const SliceSource* slices = source.slices(settings.ndf_step, codes);
  if (slices == nullptr) return {};
  residual::ResidualCode code;
  code.basis = codes;
  code.basis.shape = static_cast<std::uint8_t>(settings.shape);
  code.slices = slices->frame;
  code.channels = source.measurement.channels.count;
  Candidate c(source.frame, code, residual::coefficient_order(residual::order_shapes[settings.shape], false,
                                                              static_cast<std::uint32_t>(settings.coefficients), residual::reach_of(slices->frame)),
              source.effort.passes);
  const residual::ChannelTransform transform = source.frame.component.transform;
  c.start_ = slice_coefficients(slices->samples, c.order_, transform);
  if (c.order_.size() > static_cast<std::size_t>(largest_matrix)) {
    c.model_ = slice_diagonal(slices->samples, slices->weights, c.order_, c.start_);
    return c;
  }
  c.model_ = slice_model(slices->samples, slices->weights, c.order_, transform);
  if (!source.image().slope.empty())
    add_environment(c.model_, source.image(), slices->samples, slices->frame, source.queries(), c.order_, transform, source.environment_weight());
  return c;
}

Encoded Candidate::encode(int step_code, double lambda_scale, int layers) const {
  Encoded e;
  e.content = frame_;
  e.step_code = step_code;
  e.lambda_scale = lambda_scale;
  const Quantised q = quantise(model_, start_, order_, residual::even_only(code_.azimuth), {residual::step_of(step_code), lambda_scale, passes_});
  e.error = q.error;
  e.content.residual = make_layers(q, code_, step_code, layers);
  container::set_symmetries(e.content.component, e.content.residual);
  e.bytes = container::pack(e.content);
  return e;
}

std::vector<Encoded> Candidate::encode_to_size(std::uint64_t bytes) const {
  // in slices the lobes have no part in the value, and a first layer that is too coarse is worse than they are
  const int layers = std::max(layer_count(bytes) - (code_.slices.empty() ? 0 : 1), 1);
  std::vector<Encoded> fitting;
  const auto fits = [&](int code, double scale) {
    Encoded e = encode(code, scale, layers);
    const bool small = e.bytes.size() <= bytes;
    if (small) fitting.push_back(std::move(e));
    return small;
  };
  int coarse = 0, fine = finest_step;  // the size grows with the code
  while (coarse < fine) {
    const int middle = (coarse + fine + 1) / 2;
    if (fits(middle, 1.0))
      coarse = middle;
    else
      fine = middle - 1;
  }
  // spend what is left with a finer step and a steeper price, or a lower price at this step
  constexpr int attempts = 5;
  const std::uint64_t enough = bytes - std::min<std::uint64_t>(bytes, std::max<std::uint64_t>(bytes / 200, 1));
  const auto spend = [&](int code, double low, double high) {  // prices as powers of 2; the lower one is too large a file
    for (int i = 0; i < attempts; ++i) {
      const double middle = (low + high) / 2;
      if (!fits(code, std::exp2(middle))) {
        low = middle;
        continue;
      }
      if (fitting.back().bytes.size() >= enough) return;
      high = middle;
    }
  };
  if (coarse < finest_step) spend(coarse + 1, 0.0, fitting.empty() ? 6.0 : 2.0);
  spend(coarse, fitting.empty() ? 0.0 : -2.5, fitting.empty() ? 6.0 : 0.0);
  // steps whose sizes leap over the last bytes: their neighbours may not
  const auto filled = [&] { return std::any_of(fitting.begin(), fitting.end(), [&](const Encoded& e) { return e.bytes.size() >= least_size(bytes); }); };
  if (coarse < finest_step) {
    for (const int step : {2, 3}) {
      if (fitting.empty() || filled()) break;
      spend(std::min(coarse + step, finest_step), 0.0, 2.0 + step);
    }
    if (coarse > 0 && !fitting.empty() && !filled()) spend(coarse - 1, -4.0, 0.0);
  }
  std::stable_sort(fitting.begin(), fitting.end(), [](const Encoded& x, const Encoded& y) { return x.error < y.error; });
  return fitting;
}

}  // namespace brdf::encode

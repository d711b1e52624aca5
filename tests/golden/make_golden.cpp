// SPDX-License-Identifier: Apache-2.0
#include "golden/make_golden.h"

#include "container/lobe_codes.h"
#include "encode/bins.h"
#include "encode/candidate.h"
#include "encode/distortion.h"
#include "encode/error_model.h"
#include "encode/layers.h"
#include "encode/quantiser.h"
#include "support/slice_measurement.h"
#include "support/small_measurement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brdf::golden {
namespace {

using container::Content;
using residual::ChannelTransform;

LobeSet lobes_of(int channels) {
  const auto color = [channels](double first) {
    std::vector<double> c;
    for (int i = 0; i < channels; ++i) c.push_back(first * (1 - 0.4 * i / channels));
    return c;
  };
  return container::quantise_lobes({channels,
                                    {{LobeKind::lambert, 1, 1, color(0.27)},
                                     {LobeKind::ggx, 0.18, 0.8, color(0.09)},
                                     {LobeKind::retro_ggx, 0.4, 0.1, color(0.01)}}});
}

/// One file of each analytic model.
void add_models(std::vector<NamedContent>& all) {
  const auto add = [&all](const char* name, const AnalyticModel& model, Channels channels) {
    Content c;
    c.component.channels = std::move(channels);
    c.component.transform = ChannelTransform::identity;
    c.component.reciprocal = !std::holds_alternative<Dielectric>(model);
    c.lobes.channels = c.component.channels.count;
    c.analytic = model;
    all.push_back({name, std::move(c)});
  };
  const Channels rgb{ChannelModel::rgb, 3, {}}, scalar{ChannelModel::scalar, 1, {}};
  add("model-lambert", Lambert{{0.5f, 0.25f, 0.125f}}, rgb);
  add("model-ggx", GgxReflector{0.2f, 0.2f, {0.04f, 0.3f, 0.6f, 0.95f}}, {ChannelModel::spectral, 4, {400, 475, 550, 625}});
  add("model-anisotropic", GgxReflector{0.1f, 0.4f, {0.9f, 0.7f, 0.4f}}, rgb);
  add("model-compensated", GgxReflector{0.7f, 0.7f, {0.8f}, true}, scalar);
  add("model-mirror", Mirror{{0.9f, 0.8f, 0.7f}}, rgb);
  add("model-dielectric", Dielectric{1.5f, 3}, rgb);
  all.back().content.provenance = Provenance{"glass", "formula", "ior 1.5", "CC0", 42, 0};
  all.back().content.fitter = "libbrdf golden files";
}

Content frame(const Measurement& m, bool reciprocal) {
  Content c;
  c.component.channels = m.channels;
  c.component.reciprocal = reciprocal;
  c.component.transform = m.channels.count == 3   ? ChannelTransform::opponent
                          : m.channels.count == 1 ? ChannelTransform::identity
                                                  : ChannelTransform::cosine;
  c.lobes = lobes_of(m.channels.count);
  c.residual.basis = {17, 9, 8, 9, 118, 0, 0};
  c.residual.azimuth = reciprocal ? residual::Azimuth::symmetric : residual::Azimuth::one_way;
  c.residual.channels = m.channels.count;
  return c;
}

/// Quantised with one step and split into layers.
encode::Quantised quantised(const Measurement& m, const Content& c, std::uint32_t count, int step_code) {
  const residual::Basis basis = residual::basis_of(c.residual.basis);
  const auto order =
      residual::coefficient_order(residual::order_shapes[c.residual.basis.shape], residual::even_only(c.residual.azimuth), count);
  const encode::Bins bins = encode::sample_bins(m, c.lobes, basis, 30, 18, 12);
  const encode::ErrorModel model =
      encode::cell_model(bins, encode::cell_weights(bins, basis.epsilon, {}), basis, c.residual.azimuth, order, c.component.transform);
  return encode::quantise(model, encode::solve_coefficients(model), order, residual::even_only(c.residual.azimuth),
                          {residual::step_of(step_code), 1.0, 3});
}

void add_layers(Content& c, const Measurement& m, std::uint32_t count, int step_code, int layers) {
  c.residual = encode::make_layers(quantised(m, c, count, step_code), c.residual, step_code, layers);
}

/// A coarse layer, then one that begins again with what the coarse one rounded away.
void add_restart(Content& c, const Measurement& m, std::uint32_t count, int coarse, int fine) {
  const encode::Quantised target = quantised(m, c, count, fine);
  const double ratio = residual::step_of(coarse) / residual::step_of(fine);
  residual::Layer first{static_cast<std::uint8_t>(coarse), false, {}, {}},
      second{static_cast<std::uint8_t>(fine), true, {}, {}};
  for (std::size_t channel = 0; channel < target.q.size(); ++channel) {
    std::vector<std::int32_t> a, b;
    for (std::uint32_t j = 0; j < target.end[channel]; ++j) {
      const std::int32_t q = target.q[channel][j];
      a.push_back(j < target.end[channel] / 2 ? static_cast<std::int32_t>(std::lround(q / ratio)) : 0);
      b.push_back(static_cast<std::int32_t>(std::lround(q - a.back() * ratio)));
    }
    a.resize(target.end[channel] / 2);
    first.end.push_back(static_cast<std::uint32_t>(a.size()));
    second.end.push_back(static_cast<std::uint32_t>(b.size()));
    first.q.push_back(std::move(a));
    second.q.push_back(std::move(b));
  }
  c.residual.layers = {std::move(first), std::move(second)};
}

}  // namespace

Measurement golden_source() { return test::bumpy_measurement({90, 45, 60}); }

std::vector<NamedContent> make_contents() {
  std::vector<NamedContent> all;
  {
    const Measurement m = golden_source();
    Content c = frame(m, true);
    c.residual = {};
    all.push_back({"rgb-lobes", std::move(c)});
  }
  {
    Measurement m = golden_source();
    Content c = frame(m, true);
    add_layers(c, m, 240, 84, 3);
    // the figures are stand-ins: what counts is that they come back
    c.errors = {{0, EvalLevel::fast, 1.0 / 64, 30.25}};
    for (int i = 1; i <= static_cast<int>(c.residual.layers.size()); ++i)
      for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact})
        c.errors.push_back({i, level, 1.0 / (64 << i), 30.25 + 4 * i});
    m.provenance.description = "bumps on a diffuse and a glossy lobe";
    c.provenance = m.provenance;
    c.fitter = "libbrdf golden files";
    all.push_back({"rgb-reciprocal-layers", std::move(c)});
  }
  {
    const Measurement m = test::bumpy_measurement({90, 45, 120, true}, 1, 0.5);
    Content c = frame(m, false);
    add_layers(c, m, 160, 80, 2);
    all.push_back({"scalar-one-way", std::move(c)});
  }
  {
    const Measurement m = test::bumpy_measurement({90, 45, 60}, 4);
    Content c = frame(m, true);
    add_restart(c, m, 120, 60, 84);
    all.push_back({"spectral-restart", std::move(c)});
  }
  {
    const Measurement m = test::slice_measurement({4, 8, 24, 16, 0.4});
    Content c = frame(m, false);
    c.lobes = container::quantise_lobes({3, {{LobeKind::ggx, 0.4, 1, {0.6, 0.65, 0.7}}}});
    const auto candidate = encode::Candidate::in_slices(encode::SourceData(m, c, encode::effort_step(0)), c.residual.basis, {8, 4, 160});
    all.push_back({"rgb-slices", candidate.value().encode(112, 0.05, 3).content});
  }
  {
    const Measurement m = test::small_measurement({90, 45, 60}, 3, [](const Vec3d& wi, const Vec3d& wo, std::span<double> f) {
      const double turn = (wi.x * wo.y - wi.y * wo.x) * (wi.z - wo.z);  // reciprocal, and odd in the mirror
      for (std::size_t c = 0; c < f.size(); ++c) f[c] = 0.25 + 0.02 * static_cast<double>(c) + 0.15 * turn;
    });
    Content c = frame(m, true);
    c.lobes = container::quantise_lobes({3, {{LobeKind::lambert, 1, 1, {0.8, 0.85, 0.9}}}});
    c.residual.azimuth = residual::Azimuth::reciprocal;
    c.component.mirror_symmetric = false;
    add_layers(c, m, 90, 72, 2);
    all.push_back({"rgb-mirror-asymmetric", std::move(c)});
  }
  {
    Content c = frame(golden_source(), true);
    c.residual = {};
    c.lobes.lobes[1].color = {0.02, 0, 0.3};
    c.lobes.lobes[2].f90 = 0;
    c.lobes = container::quantise_lobes(c.lobes);
    all.push_back({"rgb-coded-lobes", std::move(c)});
  }
  {
    Content c = frame(test::bumpy_measurement({90, 45, 60}, 31), true);
    c.residual = {};
    all.push_back({"spectral-coded-lobes", std::move(c)});
  }
  add_models(all);
  return all;
}

}  // namespace brdf::golden

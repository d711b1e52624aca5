// SPDX-License-Identifier: Apache-2.0
// Contents of `.brdfc` files made up from integers alone: the same on every machine.
#pragma once

#include "container/content.h"
#include "container/lobe_codes.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace brdf::test {

/// Numerical Recipes' linear congruential generator: its sequence is fixed, unlike that of <random>'s distributions.
class Lcg {
 public:
  explicit Lcg(std::uint32_t seed) : state_(seed) {}
  std::uint32_t next() noexcept { return state_ = state_ * 1664525U + 1013904223U; }
  /// 0 to n - 1.
  std::uint32_t below(std::uint32_t n) noexcept {
    return static_cast<std::uint32_t>((std::uint64_t{next()} * n) >> 32);
  }
  /// In [0, 1).
  double unit() noexcept { return next() / 4294967296.0; }

 private:
  std::uint32_t state_;
};

/// Small values that thin out with the place, as those of a material do.
inline std::int32_t falling_value(Lcg& random, std::uint32_t place) noexcept {
  const auto reach = static_cast<std::int32_t>(12 / (1 + place / 6));
  const auto v = static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(2 * reach + 2))) - reach;
  return v > reach ? 0 : v;
}

struct LayerShape {
  std::uint8_t step = 40;
  bool restart = false;
  std::vector<std::uint32_t> end;  ///< one per channel
};

inline residual::ResidualCode residual_of(int channels, bool reciprocal, const std::vector<LayerShape>& shapes,
                                          std::uint32_t seed = 1) {
  residual::ResidualCode code;
  code.channels = channels;
  code.azimuth = reciprocal ? residual::Azimuth::symmetric : residual::Azimuth::one_way;
  code.basis = {16, 9, 5, 7, 118, 1};
  Lcg random(seed);
  for (const LayerShape& shape : shapes) {
    residual::Layer layer;
    layer.step = shape.step;
    layer.restart = shape.restart;
    layer.end = shape.end;
    for (std::size_t c = 0; c < shape.end.size(); ++c) {
      const std::uint32_t begin = residual::layer_begin(code.layers.empty() ? nullptr : &code.layers.back(), layer, c);
      std::vector<std::int32_t> q;
      for (std::uint32_t j = begin; j < shape.end[c]; ++j) q.push_back(falling_value(random, j));
      layer.q.push_back(std::move(q));
    }
    code.layers.push_back(std::move(layer));
  }
  return code;
}

/// One lobe of each kind, already on the values that a file can hold.
inline LobeSet lobes_of_each_kind(int channels) {
  const auto color = [channels](double first) {
    std::vector<double> c;
    for (int i = 0; i < channels; ++i) c.push_back(first / (1 + 0.25 * i));
    return c;
  };
  return container::quantise_lobes({channels,
                                    {{LobeKind::lambert, 1, 1, color(0.3)},
                                     {LobeKind::ggx, 0.12, 0.8, color(0.06)},
                                     {LobeKind::retro_ggx, 0.3, 0.2, color(0.02)}}});
}

/// RGB, exactly reciprocal, lobes alone.
inline container::Content lobes_content() {
  container::Content c;
  c.component.reciprocal = true;
  c.lobes = lobes_of_each_kind(3);
  return c;
}

/// RGB with three refinements, their errors and a provenance.
inline container::Content layered_content(bool reciprocal = true) {
  container::Content c = lobes_content();
  c.component.reciprocal = reciprocal;
  c.residual =
      residual_of(3, reciprocal, {{40, false, {12, 6, 4}}, {40, false, {40, 20, 4}}, {44, false, {60, 35, 10}}});
  c.errors = {{0, EvalLevel::fast, 0.031, 31.3}};
  for (int i = 1; i <= 3; ++i)
    for (const EvalLevel level : {EvalLevel::balanced, EvalLevel::exact})
      c.errors.push_back({i, level, 0.02 / i, 33.0 + i});
  c.provenance = Provenance{"made-up", "MERL", "a material of the tests", "CC0", 0x0123456789abcdefU, 4711};
  c.fitter = "a test";
  return c;
}

/// Five spectral channels, cosine transform, a layer that begins again.
inline container::Content spectral_content() {
  container::Content c;
  c.component.channels = {ChannelModel::spectral, 5, {400, 450, 500, 600, 700.5F}};
  c.component.transform = residual::ChannelTransform::cosine;
  c.lobes = lobes_of_each_kind(5);
  c.residual = residual_of(5, false, {{30, false, {10, 8, 6, 4, 2}}, {50, true, {16, 8, 4, 4, 4}}}, 7);
  return c;
}

/// One channel, not reciprocal, one refinement.
inline container::Content scalar_content() {
  container::Content c;
  c.component.channels = {ChannelModel::scalar, 1, {}};
  c.component.transform = residual::ChannelTransform::identity;
  c.lobes = lobes_of_each_kind(1);
  c.residual = residual_of(1, false, {{44, false, {30}}}, 3);
  return c;
}

}  // namespace brdf::test

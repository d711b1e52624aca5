// SPDX-License-Identifier: Apache-2.0
// Quantiser and coder at their limits, and files cut anywhere.
#include "container/content.h"
#include "encode/bins.h"
#include "encode/distortion.h"
#include "encode/error_model.h"
#include "encode/quantiser.h"
#include "residual/layer_codec.h"
#include "support/brdfc_content.h"
#include "support/numeric_bound.h"
#include "support/small_measurement.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace brdf::test {
namespace {

const char* const group = "Codec";

NumericBound rounding(group, "first rounding, with its dead zone, steps 2^4 to 2^-28: coefficient from its quantised value", "steps", 0.75);
NumericBound zero(group, "quantiser at 0: coefficients that are not 0", "count", 0);
NumericBound saturated(group, "quantiser at saturation: magnitude over the format's largest", "ratio", 1);
NumericBound coder(group, "coefficients at the coder's limits that come back different", "count", 0);
NumericBound prefix(group, "prefixes of every length, lengths misjudged", "count", 0);

encode::ErrorModel model_of(std::uint32_t count) {
  const residual::Basis basis = residual::basis_of({16, 9, 5, 7, 118, 0, 0});
  const Measurement m = bumpy_measurement({18, 9, 12});
  const encode::Bins bins = encode::sample_bins(m, {3, {{LobeKind::lambert, 1, 1, {0.3, 0.25, 0.2}}}}, basis, 12, 8, 6);
  return encode::cell_model(bins, encode::cell_weights(bins, basis.epsilon, {}), basis, residual::Azimuth::symmetric,
                            residual::coefficient_order(residual::order_shapes[0], true, count), residual::ChannelTransform::opponent);
}

TEST(Codec, QuantiserAtZeroAndAtSaturation) {
  const encode::ErrorModel model = model_of(60);
  const auto order = residual::coefficient_order(residual::order_shapes[0], true, 60);
  const std::vector<std::vector<double>> nothing(3, std::vector<double>(60, 0.0));
  const encode::Quantised none = encode::quantise(model, nothing, order, true, {1, 1, 0});
  for (const auto& channel : none.q)
    for (const std::int32_t q : channel) zero.see(std::abs(static_cast<double>(q)), [] { return std::string("step 1"); });

  const auto limit = static_cast<double>(residual::max_magnitude);
  for (int code = 0; code < 256; code += 15) {
    const double step = residual::step_of(code);
    std::vector<std::vector<double>> start(3, std::vector<double>(60, 0.0));
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < 60; ++j) start[c][j] = (j % 2 == 0 ? 1 : -1) * step * 9.9e5 * std::exp2(-0.71 * static_cast<double>(j + c));
    const encode::Quantised q = encode::quantise(model, start, order, true, {step, 0, 0});
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < 60; ++j)
        rounding.see(std::fabs(start[c][j] / step - q.q[c][j]), [&] { return "step code " + std::to_string(code); });
    for (const double factor : {2.0, 1e6, 1e30}) {
      std::vector<std::vector<double>> beyond = start;
      for (auto& channel : beyond)
        for (double& v : channel) v *= factor;
      for (const int passes : {0, 2})
        for (const auto& channel : encode::quantise(model, beyond, order, true, {step, 1, passes}).q)
          for (const std::int32_t v : channel)
            saturated.see(std::fabs(static_cast<double>(v)) / limit,
                          [&] { return "step code " + std::to_string(code) + ", coefficients times " + numbers({factor}); });
    }
  }
  zero.check();
  rounding.check();
  saturated.check();
}

TEST(Codec, CoefficientsAtTheLimitsComeBack) {
  const std::int32_t most = residual::max_magnitude;
  const std::int32_t values[] = {0, 1, -1, 14, 15, -15, 16, 254, 255, 256, -257, most - 1, most, -most, 1 << 19, -(1 << 19) - 1};
  double different = 0;
  for (std::uint32_t pattern = 0; pattern < 64; ++pattern) {
    residual::ResidualCode code = residual_of(3, true, {{static_cast<std::uint8_t>(pattern * 4), false, {97, 40, 0}}}, pattern);
    Lcg random(pattern);
    for (auto& channel : code.layers[0].q)
      for (std::int32_t& q : channel) q = pattern == 0 ? most : pattern == 1 ? 0 : values[random.below(std::size(values))];
    residual::LayerCodec writer(code.basis, true, 3, 97), reader(code.basis, true, 3, 97);
    const auto bytes = residual::encode_layer(writer, nullptr, code.layers[0]);
    const residual::Layer back = residual::decode_layer(reader, nullptr, bytes, 3, 97);
    ASSERT_EQ(back.end, code.layers[0].end);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t j = 0; j < back.q[c].size(); ++j) {
        different += back.q[c][j] == code.layers[0].q[c][j] ? 0 : 1;
        coder.see(different, [&] { return "pattern " + std::to_string(pattern); });
      }
  }
  coder.check();
}

TEST(Codec, PrefixesOfEveryLength) {
  double wrong = 0;
  const std::pair<const char*, container::Content> contents[] = {{"RGB lobes", lobes_content()},
                                                                 {"RGB layers", layered_content()},
                                                                 {"RGB layers, one way", layered_content(false)},
                                                                 {"spectral", spectral_content()},
                                                                 {"scalar", scalar_content()}};
  for (const auto& [name, content] : contents) {
    const std::vector<std::byte> bytes = container::pack(content);
    const std::vector<std::uint64_t> ends = refinement_boundaries(bytes);
    for (std::size_t length = 0; length <= bytes.size(); ++length)
      for (const bool allowed : {false, true}) {
        const bool whole = length == bytes.size(), boundary = std::find(ends.begin(), ends.end(), length) != ends.end();
        DecodeOptions options;
        options.allow_prefix = allowed;
        options.sampling = false;
        bool good = false;
        try {
          const Material m = Material::decode(std::span(bytes).first(length), options);
          std::vector<float> f(static_cast<std::size_t>(m.channels()), -1.0F);
          m.eval({0.6F, 0, 0.8F}, {0, 0.28F, 0.96F}, f);
          good = (whole || (boundary && allowed)) && std::all_of(f.begin(), f.end(), [](float v) { return std::isfinite(v) && v >= 0; });
        } catch (const Error&) {
          good = !whole && !(boundary && allowed);
        }
        wrong += good ? 0 : 1;
        prefix.see(wrong, [&, n = name] { return std::string(n) + ", " + std::to_string(length) + " bytes"; });
      }
  }
  prefix.check();
}

}  // namespace
}  // namespace brdf::test

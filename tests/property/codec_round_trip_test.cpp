// SPDX-License-Identifier: Apache-2.0
// Whatever can be said in the codec's types survives its bytes.
#include "container/content.h"
#include "container/lobe_codes.h"
#include "residual/layer_codec.h"
#include "residual/range_coder.h"

#include <brdf/error.h>
#include <brdf/material.h>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace brdf {
namespace {

using container::Content;
using residual::Layer;

/// Mostly small, sometimes as large as the format allows.
rc::Gen<std::int32_t> coefficient() {
  return rc::gen::weightedOneOf<std::int32_t>(
      {{12, rc::gen::just(0)},
       {8, rc::gen::inRange(-3, 4)},
       {2, rc::gen::inRange(-20, 21)},
       {1, rc::gen::element(15, -15, 16, -16)},
       {1, rc::gen::inRange(-residual::max_magnitude, residual::max_magnitude + 1)}});
}

residual::ResidualCode any_residual(int channels, bool reciprocal) {
  residual::ResidualCode code;
  code.channels = channels;
  code.azimuth = reciprocal ? residual::Azimuth::symmetric : residual::Azimuth::one_way;
  code.basis.kappa_h = static_cast<std::uint8_t>(*rc::gen::inRange(0, 32));
  code.basis.kappa_d = static_cast<std::uint8_t>(*rc::gen::inRange(0, 16));
  code.basis.window_h = static_cast<std::uint8_t>(*rc::gen::inRange(0, 16));
  code.basis.window_d = static_cast<std::uint8_t>(*rc::gen::inRange(0, 16));
  code.basis.epsilon = static_cast<std::uint8_t>(*rc::gen::inRange(0, residual::largest_epsilon_code + 1));
  code.basis.shape = static_cast<std::uint8_t>(*rc::gen::inRange(0, residual::order_shape_count));
  const int layers = *rc::gen::inRange(0, 5);
  for (int i = 0; i < layers; ++i) {
    Layer layer;
    layer.step = *rc::gen::arbitrary<std::uint8_t>();
    layer.restart = *rc::gen::arbitrary<bool>();
    for (int c = 0; c < channels; ++c) {
      const std::uint32_t begin = residual::layer_begin(code.layers.empty() ? nullptr : &code.layers.back(), layer,
                                                        static_cast<std::size_t>(c));
      const auto length = static_cast<std::size_t>(*rc::gen::inRange(0, 60));
      layer.end.push_back(begin + static_cast<std::uint32_t>(length));
      layer.q.push_back(*rc::gen::container<std::vector<std::int32_t>>(length, coefficient()));
    }
    code.layers.push_back(std::move(layer));
  }
  return code;
}

LobeSet any_lobes(int channels) {
  // now and then as large as the format allows
  const int largest = *rc::gen::weightedElement<int>({{9, 400}, {1, 9900}});
  const auto amplitude = [largest] { return std::exp2(*rc::gen::inRange(-1000, largest) / 100.0); };
  LobeSet set{channels, {}};
  const int count = *rc::gen::inRange(0, 6);
  for (int i = 0; i < count; ++i) {
    Lobe lobe;
    lobe.kind = static_cast<LobeKind>(*rc::gen::inRange(0, 3));
    lobe.alpha = std::pow(10.0, *rc::gen::inRange(-500, 1) / 100.0);
    lobe.f90 = amplitude();
    for (int c = 0; c < channels; ++c) lobe.color.push_back(*rc::gen::inRange(0, 4) == 0 ? 0.0 : amplitude());
    set.lobes.push_back(std::move(lobe));
  }
  return container::quantise_lobes(set);
}

Content any_content() {
  Content c;
  c.component.channels.model =
      *rc::gen::element(ChannelModel::rgb, ChannelModel::xyz, ChannelModel::spectral, ChannelModel::scalar);
  c.component.channels.count = 3;
  if (c.component.channels.model == ChannelModel::scalar) c.component.channels.count = 1;
  if (c.component.channels.model == ChannelModel::spectral) {
    c.component.channels.count = *rc::gen::inRange(1, 9);
    for (int i = 0; i < c.component.channels.count; ++i)
      c.component.channels.wavelengths_nm.push_back(380.0F + 10.0F * static_cast<float>(i) + 0.1F);
  }
  c.component.reciprocal = *rc::gen::arbitrary<bool>();
  c.component.transform =
      static_cast<residual::ChannelTransform>(*rc::gen::inRange(0, residual::channel_transform_count));
  c.lobes = any_lobes(c.component.channels.count);
  c.residual = any_residual(c.component.channels.count, c.component.reciprocal);
  if (*rc::gen::arbitrary<bool>()) {
    Provenance p;
    p.name = *rc::gen::string<std::string>();
    p.description = *rc::gen::string<std::string>();
    p.content_hash = *rc::gen::arbitrary<std::uint64_t>();
    p.file_bytes = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 50);
    c.provenance = p;
    c.fitter = *rc::gen::string<std::string>();
  }
  return c;
}

RC_GTEST_PROP(CodecRoundTrip, MixedBitsComeBack, ()) {
  // an arbitrary interleaving of adaptive and raw bits
  const auto symbols = *rc::gen::container<std::vector<std::pair<int, std::uint32_t>>>(
      rc::gen::pair(rc::gen::inRange(0, 25), rc::gen::arbitrary<std::uint32_t>()));
  residual::AdaptiveBit write_models[4], read_models[4];
  residual::RangeEncoder coder;
  for (const auto& [bits, v] : symbols) {
    if (bits == 0) {
      coder.bit(write_models[v / 2 % 4], v % 2 != 0);
    } else {
      coder.raw(bits, v & ((1U << bits) - 1U));
    }
  }
  const auto bytes = coder.finish();
  residual::RangeDecoder decoder(bytes);
  for (const auto& [bits, v] : symbols) {
    if (bits == 0) {
      RC_ASSERT(decoder.bit(read_models[v / 2 % 4]) == (v % 2 != 0));
    } else {
      RC_ASSERT(decoder.raw(bits) == (v & ((1U << bits) - 1U)));
    }
  }
  RC_ASSERT(decoder.overrun() <= 4U);
}

RC_GTEST_PROP(CodecRoundTrip, ContentsComeBackAndPackToTheSameBytes, ()) {
  const Content content = any_content();
  const auto bytes = container::pack(content);
  const container::Unpacked read = container::unpack(bytes, {}, false);
  const auto& layers = content.residual.layers;
  RC_ASSERT(read.content.residual.layers.size() == layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    RC_ASSERT(read.content.residual.layers[i].end == layers[i].end);
    RC_ASSERT(read.content.residual.layers[i].q == layers[i].q);
    RC_ASSERT(read.content.residual.layers[i].step == layers[i].step);
    RC_ASSERT(read.content.residual.layers[i].restart == layers[i].restart);
  }
  RC_ASSERT(container::pack(read.content) == bytes);
}

RC_GTEST_PROP(CodecRoundTrip, PrefixesAreCoarserFilesOrErrors, ()) {
  const auto bytes = container::pack(any_content());
  const auto ends = container::boundaries(bytes, {});
  const auto length = static_cast<std::size_t>(*rc::gen::inRange<std::uint64_t>(0, bytes.size()));
  const bool boundary = std::find(ends.begin(), ends.end(), length) != ends.end();
  try {
    container::unpack(std::span(bytes).first(length), {}, true);
    RC_ASSERT(boundary);
  } catch (const Error&) {
    RC_ASSERT(!boundary);
  }
}

RC_GTEST_PROP(CodecRoundTrip, EveryDecodedMaterialEvaluatesToNumbers, ()) {
  const Material m = Material::decode(container::pack(any_content()));
  std::vector<float> f(static_cast<std::size_t>(m.channels()));
  const auto direction = [] {
    const double z = *rc::gen::inRange(1, 1001) / 1000.0, phi = *rc::gen::inRange(0, 6283) / 1000.0,
                 s = std::sqrt(1 - z * z);
    return Vec3f(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z));
  };
  const Vec3f wi = direction(), wo = direction();
  m.eval(wi, wo, f);
  for (const float v : f) RC_ASSERT(std::isfinite(v) && v >= 0);
  const float pdf = m.pdf(wi, wo);
  RC_ASSERT(std::isfinite(pdf) && pdf >= 0);
  if (!m.info().reciprocal) return;
  std::vector<float> exchanged(f.size());
  m.eval(wo, wi, exchanged);
  RC_ASSERT(std::memcmp(f.data(), exchanged.data(), f.size() * sizeof(float)) == 0);
}

}  // namespace
}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
#include "residual/layer_codec.h"

#include "residual/order_extent.h"
#include "residual/value_codes.h"

#include <brdf/error.h>

#include <string>

namespace brdf::residual {

LayerCodec::LayerCodec(const BasisCodes& basis, bool reciprocal, int channels, std::uint32_t count, const Extent& reach)
    : reciprocal_(reciprocal),
      order_(coefficient_order(order_shapes[basis.shape], reciprocal, count, reach)),
      field_(channels, extent(order_).k, extent(order_).l, extent(order_).m) {}

Layer decode_layer(LayerCodec& codec, const Layer* before, std::span<const std::byte> bytes, std::size_t channels,
                   std::uint32_t count) {
  RangeDecoder coder(bytes);
  Layer layer;
  layer.end.resize(channels);
  layer.q.resize(channels);
  layer.step = static_cast<std::uint8_t>(coder.raw(8));
  layer.restart = coder.raw(1) != 0;
  for (std::size_t c = 0; c < channels; ++c) {
    const std::uint32_t begin = layer_begin(before, layer, c);
    const std::uint32_t length = code_count(coder, 0);
    const auto limit = std::min<std::uint32_t>(count, static_cast<std::uint32_t>(codec.order().size()));
    if (length > limit || begin > limit - length)
      throw Error(ErrorCode::malformed, "residual layer: channel " + std::to_string(c) + " ends at coefficient " +
                                            std::to_string(std::uint64_t{begin} + length) + ", at most " +
                                            std::to_string(limit) + " are declared");
    layer.end[c] = begin + length;
    layer.q[c].resize(length);
  }
  codec.code(coder, before, layer);
  if (coder.overrun() > 4) throw Error(ErrorCode::malformed, "residual layer: the coefficients go on beyond its end");
  return layer;
}

}  // namespace brdf::residual

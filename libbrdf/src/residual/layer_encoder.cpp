// SPDX-License-Identifier: Apache-2.0
#include "residual/layer_codec.h"
#include "residual/value_codes.h"

namespace brdf::residual {

std::vector<std::byte> encode_layer(LayerCodec& codec, const Layer* before, const Layer& layer) {
  RangeEncoder coder;
  coder.raw(8, layer.step);
  coder.raw(1, layer.restart ? 1U : 0U);
  for (std::size_t c = 0; c < layer.end.size(); ++c) code_count(coder, layer.end[c] - layer_begin(before, layer, c));
  Layer copy = layer;
  codec.code(coder, before, copy);
  return coder.finish();
}

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
// Residual layers as bytes. Layers must be coded in order with one LayerCodec: what was learnt goes on.
#pragma once

#include "residual/coefficient_model.h"
#include "residual/residual_code.h"

#include <cstddef>
#include <span>
#include <vector>

namespace brdf::residual {

/// State shared by encoder and decoder of one residual.
class LayerCodec {
 public:
  /// `count`: how many places of the order any layer may use.
  LayerCodec(const BasisCodes& basis, bool reciprocal, int channels, std::uint32_t count,
             const Extent& reach = {max_k, max_l, max_m});

  /// Codes the coefficients of a layer whose ends are known, with any coder; fills or reads layer.q.
  template <class Coder>
  void code(Coder& coder, const Layer* before, Layer& layer) {
    if (layer.restart) field_.clear();
    std::uint32_t first = UINT32_MAX, last = 0;
    for (std::size_t c = 0; c < layer.end.size(); ++c) {
      first = std::min(first, layer_begin(before, layer, c));
      last = std::max(last, layer.end[c]);
    }
    for (std::uint32_t j = first; j < last; ++j)
      for (std::size_t c = 0; c < layer.end.size(); ++c) {
        const std::uint32_t begin = layer_begin(before, layer, c);
        if (j < begin || j >= layer.end[c]) continue;
        const int channel = static_cast<int>(c);
        std::int32_t& q = layer.q[c][j - begin];
        const int activity = activity_class(field_.activity(channel, order_[j], reciprocal_));
        q = model_.code(coder, c == 0, activity, radius_class(j), q);
        if (q != 0) field_.set(channel, order_[j], q);
      }
  }
  const std::vector<Frequency>& order() const noexcept { return order_; }

 private:
  bool reciprocal_;
  std::vector<Frequency> order_;
  MagnitudeField field_;
  CoefficientModel model_;
};

/// Bytes of one layer: step, restart flag, ends, coefficients.
std::vector<std::byte> encode_layer(LayerCodec& codec, const Layer* before, const Layer& layer);

/// The inverse. Throws Error(malformed) when the bytes contradict the format; `count` bounds the ends.
Layer decode_layer(LayerCodec& codec, const Layer* before, std::span<const std::byte> bytes, std::size_t channels,
                   std::uint32_t count);

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
#include "encode/layers.h"

#include <algorithm>
#include <bit>

namespace brdf::encode {

int layer_count(std::uint64_t file_bytes) noexcept {
  return std::clamp(static_cast<int>(std::bit_width(file_bytes / 640)) + 1, 1, 6);
}

residual::ResidualCode make_layers(const Quantised& quantised, const residual::ResidualCode& empty, int step_code, int count) {
  residual::ResidualCode code = empty;
  const std::uint32_t last = *std::max_element(quantised.end.begin(), quantised.end.end());
  if (last == 0) return code;

  std::vector<std::uint32_t> living(last + 1, 0);  // coefficients that are not 0 before place j
  for (std::uint32_t j = 0; j < last; ++j) {
    living[j + 1] = living[j];
    for (const auto& q : quantised.q) living[j + 1] += q[j] != 0 ? 1U : 0U;
  }
  std::vector<std::uint32_t> begin(quantised.q.size(), 0);
  for (int i = 0; i < count; ++i) {
    const std::uint32_t wanted = living[last] >> (count - 1 - i);
    const auto cut = static_cast<std::uint32_t>(std::lower_bound(living.begin(), living.end(), wanted) - living.begin());
    residual::Layer layer;
    layer.step = static_cast<std::uint8_t>(step_code);
    bool any = false;
    for (std::size_t c = 0; c < begin.size(); ++c) {
      const std::uint32_t end = std::max(begin[c], std::min(i + 1 == count ? last : cut, quantised.end[c]));
      layer.end.push_back(end);
      layer.q.emplace_back(quantised.q[c].begin() + begin[c], quantised.q[c].begin() + end);
      any = any || end > begin[c];
      begin[c] = end;
    }
    if (any) code.layers.push_back(std::move(layer));
  }
  return code;
}

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
#include "residual/channel_transform.h"

#include <cmath>
#include <numbers>

namespace brdf::residual {

std::vector<double> channel_matrix(ChannelTransform t, int n) {
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> m(size * size, 0.0);
  if (t == ChannelTransform::opponent && n == 3) {
    const double a = 1 / std::sqrt(3.0), b = 1 / std::sqrt(2.0), c = 1 / std::sqrt(6.0);
    return {a, a, a, b, 0, -b, c, -2 * c, c};
  }
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j) {
      if (t == ChannelTransform::cosine) {
        const double scale = std::sqrt((i == 0 ? 1.0 : 2.0) / n);
        m[i * size + j] = scale * std::cos(std::numbers::pi * static_cast<double>(i) * (static_cast<double>(j) + 0.5) / n);
      } else {
        m[i * size + j] = i == j ? 1.0 : 0.0;
      }
    }
  return m;
}

}  // namespace brdf::residual

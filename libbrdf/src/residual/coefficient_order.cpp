// SPDX-License-Identifier: Apache-2.0
#include "residual/coefficient_order.h"

namespace brdf::residual {

std::vector<Frequency> coefficient_order(const OrderShape& shape, bool even_m_only, std::uint32_t count, const Extent& reach) {
  // bucket sort by radius: deterministic and linear
  const int largest = shape.k * (reach.k - 1) + shape.l * (reach.l - 1) + shape.m * (reach.m - 1);
  const int step_m = even_m_only ? 2 : 1;
  std::vector<Frequency> order;
  order.reserve(count);
  for (int radius = 0; radius <= largest && order.size() < count; ++radius)
    for (int m = 0; m < reach.m && shape.m * m <= radius; m += step_m)
      for (int l = 0; l < reach.l && shape.m * m + shape.l * l <= radius; ++l) {
        const int rest = radius - shape.m * m - shape.l * l;
        if (rest % shape.k != 0 || rest / shape.k >= reach.k) continue;
        if (order.size() == count) return order;
        order.push_back({static_cast<std::uint8_t>(rest / shape.k), static_cast<std::uint8_t>(l), static_cast<std::uint8_t>(m)});
      }
  return order;
}

}  // namespace brdf::residual

// SPDX-License-Identifier: Apache-2.0
// The order in which coefficients travel: from low to high frequency, so that the end of a layer cuts the smallest.
#pragma once

#include <cstdint>
#include <vector>

namespace brdf::residual {

/// Frequencies of one basis function: cos(pi k u_h) cos(pi l u_d) cos(m phi_d) window^m, or, in slices, of cosines along
/// the elevation of the normal, its azimuth, and theta_i.
struct Frequency {
  std::uint8_t k, l, m;
};

inline constexpr int max_k = 64, max_l = 32, max_m = 24;  ///< exclusive bounds of the format

/// How far an order reaches along each axis.
struct Extent {
  int k = 0, l = 0, m = 0;  ///< one past the largest frequency
};

/// How much a step along each axis counts. Part of the format: entries are only ever added.
struct OrderShape {
  int k, l, m;
};
inline constexpr OrderShape order_shapes[] = {{10, 17, 24}, {8, 20, 30}, {6, 20, 30}, {14, 14, 22},
                                              {10, 20, 17}, {8, 12, 40}, {5, 30, 40}, {14, 20, 14}};
inline constexpr int order_shape_count = 8;

/// The first `count` frequencies by increasing shape.k * k + shape.l * l + shape.m * m, ties by m, then l, then k.
/// With `even_m_only` (exactly reciprocal materials) odd m are left out. Fewer when the bounds run out.
std::vector<Frequency> coefficient_order(const OrderShape& shape, bool even_m_only, std::uint32_t count,
                                         const Extent& reach = {max_k, max_l, max_m});

}  // namespace brdf::residual

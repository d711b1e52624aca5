// SPDX-License-Identifier: Apache-2.0
// Arc tangent by Abramowitz and Stegun (1964), formula 4.4.49: error below 2e-8 on [0, 1], in terms of x squared.
#pragma once

#include <array>

namespace brdf::peers {

/// atan(x) / x = 1 + x^2 (a[0] + x^2 (a[1] + ...)) for x in [0, 1].
inline constexpr std::array<float, 8> arc_tangent_series = {-0.3333314528F, 0.1999355085F,  -0.1420889944F,
                                                            0.1065626393F,  -0.0752896400F, 0.0429096138F,
                                                            -0.0161657367F, 0.0028662257F};

}  // namespace brdf::peers

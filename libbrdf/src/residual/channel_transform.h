// SPDX-License-Identifier: Apache-2.0
// Orthonormal transforms across channels. Identifiers are part of the file format.
#pragma once

#include <cstdint>
#include <vector>

namespace brdf::residual {

enum class ChannelTransform : std::uint8_t {
  identity = 0,
  opponent = 1,  ///< three channels: (1,1,1)/sqrt3, (1,0,-1)/sqrt2, (1,-2,1)/sqrt6
  cosine = 2,    ///< any number: orthonormal DCT-II along the channels
};
inline constexpr int channel_transform_count = 3;

/// Row-major n x n matrix T: coefficients = T values, values = T^t coefficients. Opponent with n != 3 gives identity.
std::vector<double> channel_matrix(ChannelTransform t, int n);

}  // namespace brdf::residual

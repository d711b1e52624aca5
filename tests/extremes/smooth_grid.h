// SPDX-License-Identifier: Apache-2.0
// Residual grids as files hold them: a sum of the basis functions, which do not depend on phi_d where it has no meaning.
#pragma once

#include "residual/reconstruct.h"
#include "support/brdfc_content.h"

namespace brdf::test {

/// Some sixty coefficients, log ratios up to about 1.
inline residual::Coefficients smooth_coefficients(residual::Azimuth azimuth, int channels = 3) {
  residual::ResidualCode code = residual_of(channels, residual::is_reciprocal(azimuth),
                                            {{76, false, std::vector<std::uint32_t>(static_cast<std::size_t>(channels), 60)}}, 5);
  code.azimuth = azimuth;
  return residual::dequantise(code, residual::ChannelTransform::opponent, 1);
}

inline residual::ResidualGrid smooth_grid(residual::Azimuth azimuth, int channels = 3,
                                          const residual::GridSize& size = residual::balanced_grids[0]) {
  return residual::reconstruct(smooth_coefficients(azimuth, channels), size);
}

}  // namespace brdf::test

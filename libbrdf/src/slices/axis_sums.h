// SPDX-License-Identifier: Apache-2.0
// Cosine sums along one axis of a cube; the instruction set is chosen at run time, every one gives the same bits.
#pragma once

#include <cstddef>
#include <vector>

namespace brdf::slices {

/// out[a][i][b] = sum over j of cos(pi j (i + 1/2) / n) in[a][j][b] for a cube [outer][n][inner].
std::vector<float> cosine_sums(const std::vector<float>& in, std::size_t outer, std::size_t n, std::size_t inner);

}  // namespace brdf::slices

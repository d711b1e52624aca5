// SPDX-License-Identifier: Apache-2.0
// The last steps from node values to the table: nodes moved to where lines between them fit best, then half floats. The
// instruction set is chosen at run time; every one gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace brdf::decode {

/// Lines between nodes on a curve lie to one side of it. Moved by a twelfth of the second difference they fit it best in the
/// least-squares sense. Along the middle axis of [outer][n][inner]; ends stay, and no node moves by more than a twentieth:
/// where it would have to, the nodes do not resolve the curve.
void least_squares_nodes(std::span<const float> nodes, std::size_t outer, std::size_t n, std::size_t inner, std::span<float> out);

/// Clamped to 6.2e-5 ... 32000.
void to_halves(std::span<const float> nodes, std::span<std::uint16_t> out);

}  // namespace brdf::decode

// SPDX-License-Identifier: Apache-2.0
// The two inner loops in which the encoder spends its time. Every element of the output is one sum in one order, with no
// fused multiply-add, so that vectors of any width give the same bits.
#pragma once

#include <cstddef>

namespace brdf::encode {

/// out[i] += factor * in[i]
void add_scaled(double* out, const double* in, double factor, std::size_t n);

/// gram += scale * rows^t rows, for `count` rows of n numbers and a symmetric n x n matrix.
void add_outer_products(double* gram, std::size_t n, const double* rows, std::size_t count, double scale);

}  // namespace brdf::encode

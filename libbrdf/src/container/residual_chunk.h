// SPDX-License-Identifier: Apache-2.0
// Head of the first residual chunk: the basis, and how many coefficients its layers may use.
#pragma once

#include "container/bit_stream.h"
#include "residual/residual_code.h"

#include <cstdint>

namespace brdf::container {

inline void write_basis(BitWriter& out, const residual::BasisCodes& b, std::uint32_t count) {
  out.put(b.kappa_h, 5);
  out.put(b.kappa_d, 4);
  out.put(b.window_h, 4);
  out.put(b.window_d, 4);
  out.put(b.epsilon, 8);
  out.put(b.shape, 3);
  out.put(count, 15);
  out.put(b.table, 2);
  out.put(0, 3);  // reserved
}

inline residual::BasisCodes read_basis(BitReader& in, std::uint32_t& count) {
  residual::BasisCodes b;
  b.kappa_h = static_cast<std::uint8_t>(in.get(5));
  b.kappa_d = static_cast<std::uint8_t>(in.get(4));
  b.window_h = static_cast<std::uint8_t>(in.get(4));
  b.window_d = static_cast<std::uint8_t>(in.get(4));
  b.epsilon = static_cast<std::uint8_t>(in.get(8));
  b.shape = static_cast<std::uint8_t>(in.get(3));
  count = in.get(15);
  if (count > residual::max_coefficients)
    throw Error(ErrorCode::malformed, "residual: " + std::to_string(count) + " coefficients are declared, at most " +
                                          std::to_string(residual::max_coefficients) + " are allowed");
  if (b.epsilon > residual::largest_epsilon_code)
    throw Error(ErrorCode::malformed, "residual: epsilon code " + std::to_string(b.epsilon) + ", at most " +
                                          std::to_string(residual::largest_epsilon_code) + " is allowed");
  b.table = static_cast<std::uint8_t>(in.get(2));
  if (in.get(3) != 0) throw Error(ErrorCode::malformed, "residual: reserved bits are set");
  return b;
}

}  // namespace brdf::container

// SPDX-License-Identifier: Apache-2.0
// MERL files in memory, written independently of the library's own writer.
#pragma once

#include "support/tensor_file_builder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace brdf::test {

inline std::vector<std::byte> merl_header(const std::array<std::int32_t, 3>& n) {
  std::vector<std::byte> out;
  for (const std::int32_t bins : n) append(out, bins);
  return out;
}

/// 90 x 90 x n_phi_d; raw(channel, i, j, k) gives the stored number.
template <class Raw>
std::vector<std::byte> merl_bytes(int n_phi_d, Raw&& raw) {
  std::vector<std::byte> out = merl_header({90, 90, n_phi_d});
  std::size_t at = out.size();
  out.resize(at + std::size_t{3} * 90 * 90 * static_cast<std::size_t>(n_phi_d) * 8);
  for (int c = 0; c < 3; ++c) {
    for (int i = 0; i < 90; ++i) {
      for (int j = 0; j < 90; ++j) {
        for (int k = 0; k < n_phi_d; ++k, at += 8) {
          base::store_little_endian(static_cast<double>(raw(c, i, j, k)), std::span(out).subspan(at, 8));
        }
      }
    }
  }
  return out;
}

}  // namespace brdf::test

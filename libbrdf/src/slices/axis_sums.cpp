// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slices/axis_sums.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "residual/basis.h"
#include "slices/axis_sums.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "residual/add_scaled-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::slices::HWY_NAMESPACE {
using residual::HWY_NAMESPACE::add_scaled;

void run_cosine_sums(const float* HWY_RESTRICT in, const float* HWY_RESTRICT cosine, std::size_t outer, std::size_t n,
                     std::size_t inner, float* HWY_RESTRICT out) {
  for (std::size_t a = 0; a < outer; ++a)
    for (std::size_t j = 0; j < n; ++j) {
      const float* from = in + (a * n + j) * inner;
      if (std::all_of(from, from + inner, [](float v) { return v == 0; })) continue;
      if (inner == 1) {
        add_scaled(*from, cosine + j * n, out + a * n, n);
      } else {
        for (std::size_t i = 0; i < n; ++i) add_scaled(cosine[j * n + i], from, out + (a * n + i) * inner, inner);
      }
    }
}

}  // namespace brdf::slices::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::slices {

HWY_EXPORT(run_cosine_sums);

namespace {

/// table[j * n + i] = cos(pi j (i + 1/2) / n)
std::vector<float> cosines_at_middles(std::size_t n) {
  std::vector<float> table(n * n), row(n);
  for (std::size_t i = 0; i < n; ++i) {
    residual::cosines(std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n)), static_cast<int>(n), row.data());
    for (std::size_t j = 0; j < n; ++j) table[j * n + i] = row[j];
  }
  return table;
}

}  // namespace

std::vector<float> cosine_sums(const std::vector<float>& in, std::size_t outer, std::size_t n, std::size_t inner) {
  const std::vector<float> cosine = cosines_at_middles(n);
  std::vector<float> out(in.size(), 0.0f);
  HWY_DYNAMIC_DISPATCH(run_cosine_sums)(in.data(), cosine.data(), outer, n, inner, out.data());
  return out;
}

}  // namespace brdf::slices
#endif

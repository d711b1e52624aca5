// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "decode/node_shift.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "decode/node_shift.h"
#include "residual/half_float.h"

#include <hwy/highway.h>

#include <algorithm>

#include "residual/half_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::decode::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using residual::HWY_NAMESPACE::Floats;
using residual::HWY_NAMESPACE::V;

constexpr float largest_share = 0.05f, twelfth = 1.0f / 12;
constexpr float smallest_ratio = 6.2e-5f, largest_ratio = 32000.0f;

/// `count` nodes at `p`, whose neighbours are `step` floats away.
void run_shift(const float* HWY_RESTRICT p, std::size_t count, std::size_t step, float* HWY_RESTRICT out) {
  const Floats d;
  const V two = hn::Set(d, 2.0f), share = hn::Set(d, largest_share), scale = hn::Set(d, twelfth);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const V node = hn::LoadU(d, p + i), most = hn::Mul(share, node);
    const V bend = hn::Add(hn::Sub(hn::LoadU(d, p + i - step), hn::Mul(two, node)), hn::LoadU(d, p + i + step));
    hn::StoreU(hn::Sub(node, hn::Min(hn::Max(hn::Mul(bend, scale), hn::Neg(most)), most)), d, out + i);
  }
  for (; i < count; ++i) {
    const float most = largest_share * p[i], bend = p[i - step] - 2.0f * p[i] + p[i + step];
    out[i] = p[i] - std::min(std::max(bend * twelfth, -most), most);
  }
}

void run_to_halves(const float* HWY_RESTRICT p, std::size_t count, std::uint16_t* HWY_RESTRICT out) {
  const Floats d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    residual::HWY_NAMESPACE::store_halves(hn::Min(hn::Max(hn::LoadU(d, p + i), hn::Set(d, smallest_ratio)), hn::Set(d, largest_ratio)), out + i);
  for (; i < count; ++i) out[i] = residual::half_from_float(std::clamp(p[i], smallest_ratio, largest_ratio));
}

}  // namespace brdf::decode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::decode {

HWY_EXPORT(run_shift);
HWY_EXPORT(run_to_halves);

void least_squares_nodes(std::span<const float> nodes, std::size_t outer, std::size_t n, std::size_t inner, std::span<float> out) {
  std::copy(nodes.begin(), nodes.end(), out.begin());
  if (n < 3) return;
  for (std::size_t a = 0; a < outer; ++a) {
    const std::size_t first = (a * n + 1) * inner;
    HWY_DYNAMIC_DISPATCH(run_shift)(nodes.data() + first, (n - 2) * inner, inner, out.data() + first);
  }
}

void to_halves(std::span<const float> nodes, std::span<std::uint16_t> out) {
  HWY_DYNAMIC_DISPATCH(run_to_halves)(nodes.data(), nodes.size(), out.data());
}

}  // namespace brdf::decode
#endif

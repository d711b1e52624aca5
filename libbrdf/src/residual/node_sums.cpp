// SPDX-License-Identifier: Apache-2.0
#include "base/highway_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "residual/node_sums.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set

#include "residual/node_sums.h"

#include <hwy/highway.h>

#include <algorithm>

#include "residual/add_scaled-inl.h"
#include "residual/half_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace brdf::residual::HWY_NAMESPACE {

/// exp for |x| < 80, relative error below 3e-7 (Cephes expf, Moshier 1989).
HWY_INLINE V exponential(V x) {
  const Floats d;
  const hn::RebindToSigned<Floats> ints;
  const auto set = [d](float v) HWY_ATTR { return hn::Set(d, v); };
  const V t = hn::Mul(x, set(1.44269504F));
  const auto whole_bits = hn::ConvertTo(ints, hn::Add(t, hn::CopySign(set(0.5F), t)));
  const V whole = hn::ConvertTo(d, whole_bits);
  const V r = hn::Add(hn::Sub(x, hn::Mul(whole, set(0.693359375F))), hn::Mul(whole, set(2.12194440e-4F)));
  V p = set(1.9875691500e-4F);
  for (const float c : {1.3981999507e-3F, 8.3334519073e-3F, 4.1665795894e-2F, 1.6666665459e-1F, 5.0000001201e-1F})
    p = hn::Add(hn::Mul(p, r), set(c));
  const V e = hn::Add(hn::Add(hn::Mul(hn::Mul(p, r), r), r), set(1.0F));
  return hn::Mul(e, hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(whole_bits, hn::Set(ints, 127)))));
}

/// Sums over k: [m][l][h]; whether anything is there: used[m][l].
void sum_along_h(const NodeSums& s, float* HWY_RESTRICT along_h, char* HWY_RESTRICT used) {
  for (std::size_t j = 0; j < s.value.size(); ++j) {
    if (s.value[j] == 0.0F) continue;
    const std::size_t lm = s.order[j].m * s.frequencies_d + s.order[j].l;
    used[lm] = 1;
    add_scaled(s.value[j], s.cosine_h + s.order[j].k * s.stride_h, along_h + lm * s.stride_h, s.stride_h);
  }
}

/// Sums over l, times the windows: one row of theta_d of each harmonic.
void sum_row(const NodeSums& s, const float* HWY_RESTRICT along_h, const char* HWY_RESTRICT used, std::size_t h,
             float* HWY_RESTRICT row) {
  const Floats d;
  std::fill(row, row + s.harmonics * s.stride_d, 0.0F);
  for (std::size_t m = 0; m < s.harmonics; ++m) {
    float* out = row + m * s.stride_d;
    for (std::size_t l = 0; l < s.frequencies_d; ++l)
      if (used[m * s.frequencies_d + l] != 0)
        add_scaled(along_h[(m * s.frequencies_d + l) * s.stride_h + h], s.cosine_d + l * s.stride_d, out, s.stride_d);
    const V window = hn::Set(d, s.window_h[m * s.stride_h + h]);
    for (std::size_t i = 0; i < s.stride_d; i += hn::Lanes(d))
      hn::StoreU(hn::Mul(hn::LoadU(d, out + i), hn::Mul(window, hn::LoadU(d, s.window_d + m * s.stride_d + i))), d, out + i);
  }
}

void run_sum_nodes(const NodeSums& s, std::uint16_t* HWY_RESTRICT ratio) {
  // halves stay normal: ratios between 2^-14 and 2^15
  constexpr float log_ratio_min = -9.7F, log_ratio_max = 10.39F;
  const Floats d;
  const std::size_t lanes = hn::Lanes(d);
  std::vector<float> along_h(s.harmonics * s.frequencies_d * s.stride_h), row(s.harmonics * s.stride_d);
  std::vector<char> used(s.harmonics * s.frequencies_d);
  sum_along_h(s, along_h.data(), used.data());
  for (std::size_t h = 0; h < s.n_h; ++h) {
    sum_row(s, along_h.data(), used.data(), h, row.data());
    for (std::size_t j = 0; j < s.n_d; ++j, ratio += s.stride_p) {
      for (std::size_t p = 0; p < s.stride_p; p += lanes) {
        V sum = hn::Zero(d);
        for (std::size_t m = 0; m < s.harmonics; ++m)
          sum = hn::Add(sum, hn::Mul(hn::Set(d, row[m * s.stride_d + j]), hn::LoadU(d, s.cosine_p + m * s.stride_p + p)));
        const V log_ratio = hn::Min(hn::Max(sum, hn::Set(d, log_ratio_min)), hn::Set(d, log_ratio_max));
        store_halves(exponential(log_ratio), ratio + p);
      }
    }
  }
}

}  // namespace brdf::residual::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace brdf::residual {

HWY_EXPORT(run_sum_nodes);

void sum_nodes(const NodeSums& s, std::uint16_t* ratio) { HWY_DYNAMIC_DISPATCH(run_sum_nodes)(s, ratio); }

}  // namespace brdf::residual
#endif

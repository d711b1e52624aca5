// SPDX-License-Identifier: Apache-2.0
#include "eval/scalar_eval.h"

#include "eval/scalar_grid.h"

#include <array>
#include <numbers>

namespace brdf::eval {

namespace {

constexpr float scaled_half_inv_pi = static_cast<float>(0.5 * std::numbers::inv_pi) * ndf_scale * ndf_scale;
constexpr float inv_pi = std::numbers::inv_pi_v<float>;

/// D = numerator / denominator^2 with
///   numerator = |s|^4 / pi,   denominator = |s|^2 (sin^2 theta_h / alpha + alpha cos^2 theta_h),
/// kept apart so that one division serves D and what it is divided by. Near the peak no digits cancel, and with ndf_scale
/// nothing leaves the range of float at alpha 1e-5. Here the numerator is halved, as f wants it.
struct Ndf {
  float numerator, denominator;
};

inline Ndf ndf(const GgxLobe& g, const PairTerms& p) noexcept {
  const float in_plane = g.retro ? p.d_xy2 : p.s_xy2;
  const float s2 = in_plane + p.s_z2;
  return {scaled_half_inv_pi * (s2 * s2), in_plane * g.inv_alpha + p.s_z2 * g.alpha};
}

/// D G2 / (4 cos_i cos_o), with G2 of Heitz 2014, eq. 99: 1 / (2 (co sqrt(a2 + (1 - a2) ci^2) + ci sqrt(...))).
inline float ggx_value(const GgxLobe& g, const PairTerms& p) noexcept {
  const float shadowing = p.low * std::sqrt(g.alpha2 + g.one_minus_alpha2 * (p.high * p.high)) +
                          p.high * std::sqrt(g.alpha2 + g.one_minus_alpha2 * (p.low * p.low));
  const Ndf n = ndf(g, p);
  return n.numerator / (n.denominator * n.denominator * std::max(shadowing, g.least_shadowing));
}

/// Lobe values apart from colour: f_c = lambert_c + sum f0_kc plain_k + grazing.
struct LobeValues {
  std::array<float, max_ggx_lobes> plain;
  float grazing = 0;
};

inline LobeValues lobe_values(const LobeParams& lobes, const PairTerms& p) noexcept {
  LobeValues v;
  const float forward = schlick_weight(p.s * p.inv_norm);
  const float backward = lobes.forward_count < lobes.ggx.size() ? schlick_weight(std::sqrt(p.d_xy2 + p.s_z2) * p.inv_norm) : 0.0f;
  for (std::size_t k = 0; k < lobes.ggx.size(); ++k) {
    const GgxLobe& g = lobes.ggx[k];
    const float value = ggx_value(g, p), fresnel = g.retro ? backward : forward;
    v.plain[k] = value - value * fresnel;
    v.grazing += g.f90 * (value * fresnel);
  }
  return v;
}

inline float lobe_sum(const LobeParams& lobes, const LobeValues& v, std::size_t c) noexcept {
  float sum = lobes.lambert[c] + v.grazing;
  for (std::size_t k = 0; k < lobes.ggx.size(); ++k) sum += lobes.ggx[k].f0[c] * v.plain[k];
  return sum;
}

inline float with_ratio(float lobes, float ratio, float epsilon) noexcept {
  return std::max((lobes + epsilon) * ratio - epsilon, 0.0f);
}

/// Three channels, the usual case, with loops that the compiler unrolls.
void eval_rgb(const LobeParams& lobes, const GridParams& g, const PairTerms& p, float* f) noexcept {
  const LobeValues v = lobe_values(lobes, p);
  float sum[3];
  for (std::size_t c = 0; c < 3; ++c) sum[c] = lobes.lambert[c] + v.grazing;
  for (std::size_t k = 0; k < lobes.ggx.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += lobes.ggx[k].f0[c] * v.plain[k];
  if (g.ratio) {
    const GridPosition at = grid_position(g, p);
    float r[8];  // the six halves of two neighbours along p are adjacent
    interpolate_rows(g, at, 0, r);
    for (std::size_t c = 0; c < 3; ++c) sum[c] = with_ratio(sum[c], r[c] + (r[c + 3] - r[c]) * at.p, g.epsilon);
  }
  for (std::size_t c = 0; c < 3; ++c) f[c] = sum[c];
}

void eval_terms(const LobeParams& lobes, const GridParams& g, const PairTerms& p, std::span<float> f) noexcept {
  if (f.size() == 3) return eval_rgb(lobes, g, p, f.data());
  const LobeValues v = lobe_values(lobes, p);
  for (std::size_t c = 0; c < f.size(); ++c) f[c] = lobe_sum(lobes, v, c);
  if (!g.ratio) return;
  const GridPosition at = grid_position(g, p);
  const auto step = static_cast<std::size_t>(g.step_p);
  for (std::size_t first = 0; first < f.size(); first += 8) {
    float below[8], above[8];
    interpolate_rows(g, at, first, below);
    interpolate_rows(g, at, first + step, above);
    for (std::size_t c = 0; c < std::min(f.size() - first, std::size_t{8}); ++c)
      f[first + c] = with_ratio(f[first + c], below[c] + (above[c] - below[c]) * at.p, g.epsilon);
  }
}

}  // namespace

void eval_scalar(const LobeParams& lobes, const GridParams& grid, const Vec3f& wi, const Vec3f& wo,
                 std::span<float> f) noexcept {
  const PairTerms p = pair_terms(wi, wo);
  f = f.first(static_cast<std::size_t>(lobes.channels));
  if (p.valid)
    eval_terms(lobes, grid, p, f);
  else
    std::fill(f.begin(), f.end(), 0.0f);
}

}  // namespace brdf::eval

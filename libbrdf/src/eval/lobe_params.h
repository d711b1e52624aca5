// SPDX-License-Identifier: Apache-2.0
// A LobeSet in the form that evaluation reads: float, products precomputed, Lambert lobes added up.
#pragma once

#include "eval/pair_terms.h"

#include <brdf/lobes.h>

#include <array>
#include <cstddef>
#include <vector>

namespace brdf::eval {

/// Most GGX lobes of one material: evaluation keeps a value for each on the stack.
inline constexpr int max_ggx_lobes = 16;
/// Largest reflectance of a lobe.
inline constexpr double max_reflectance = 1e30;
/// Largest value of a lobe, 1/sr: what is beyond is cut. The sum of all lobes times the largest ratio of a residual stays
/// below the largest float.
inline constexpr double max_lobe_value = 1e32;
inline constexpr double min_alpha = 1e-5;

/// Constants of one GGX lobe, one cache line.
struct alignas(64) GgxLobe {
  float alpha = ndf_scale, inv_alpha = ndf_scale;  ///< times ndf_scale
  float alpha2 = 1, one_minus_alpha2 = 0;
  float f90 = 1;
  float least_shadowing = 1e-30f;  ///< smaller ones count as this: no value is above max_lobe_value
  bool retro = false;
  const float* f0 = nullptr;  ///< one value per channel, padded with 0 to padded_channels
};

/// The same of four lobes, lane by lane; lobes that fill up the last four have no colour.
struct alignas(64) FourLobes {
  std::array<float, 4> alpha, inv_alpha, alpha2, one_minus_alpha2, f90, least_shadowing, retro;  ///< retro: 1 or 0
};

struct LobeParams {
  int channels = 0;
  std::vector<GgxLobe> ggx;         ///< reflection lobes first, then retro lobes
  std::vector<FourLobes> fours;     ///< the same again, for evaluation of one pair
  std::size_t forward_count = 0;    ///< number of reflection lobes
  std::size_t padded_channels = 0;  ///< the next multiple of 8, so that kernels may read whole vectors of colours
  std::vector<float> lambert;  ///< sum of rho / pi, one per padded channel
  std::vector<float> f0;       ///< of all GGX lobes, lobe by lobe; 0 for those that fill up the last four

  LobeParams() = default;
  /// Throws Error(invalid_argument) or Error(limit_exceeded) for a set that cannot be evaluated.
  explicit LobeParams(const LobeSet& set);
  LobeParams(const LobeParams&) = delete;
  LobeParams& operator=(const LobeParams&) = delete;
  LobeParams(LobeParams&&) noexcept = default;  // the heap blocks stay, and so the pointers into f0
  LobeParams& operator=(LobeParams&&) noexcept = default;
};

}  // namespace brdf::eval

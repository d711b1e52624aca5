// SPDX-License-Identifier: Apache-2.0
// Weights of the sampling mixture: one cosine component and every GGX lobe, by the direction wo.
#pragma once

#include "eval/lobe_params.h"

#include <array>
#include <cstddef>
#include <vector>

namespace brdf::eval {

struct Tables;

/// Component 0 is the cosine lobe and takes what the GGX lobes leave: its weight is 1 - sum of the others.
///
/// Each weight is a polynomial of degree 5 in cos theta_o in Bernstein form. Control values that are positive and add up
/// to one at each control point make weights that do so everywhere; its first basis function, (1 - cos)^5, is the
/// Schlick term. No table means no gather, which costs more than the density itself on processors with the mitigation
/// of Gather Data Sampling.
struct Mixture {
  static constexpr std::size_t controls = 6;
  using Curve = std::array<float, controls>;  ///< control values times binomials
  std::vector<Curve> lobe;                    ///< one per GGX lobe

  Mixture() = default;
  /// From lobes and residual of the tables; what `mixture` holds of them is not read.
  explicit Mixture(const Tables& t);
};

/// (1 - x)^(5 - j) x^j: the Bernstein basis without its binomials.
inline Mixture::Curve bernstein_powers(float x) noexcept {
  const float y = 1.0f - x, x2 = x * x, y2 = y * y, x4 = x2 * x2, y4 = y2 * y2;
  return {y4 * y, y4 * x, y2 * y * x2, y2 * (x2 * x), y * x4, x4 * x};
}

inline float mixture_weight(const Mixture::Curve& curve, const Mixture::Curve& powers) noexcept {
  float w = 0;
  for (std::size_t j = 0; j < Mixture::controls; ++j) w += curve[j] * powers[j];
  return w;
}

}  // namespace brdf::eval

// SPDX-License-Identifier: Apache-2.0
#include <brdf/fresnel.h>

#include "analytic/fresnel_terms.h"

namespace brdf {
namespace {

float schlick_of(double cos_i, double f0, double f90) noexcept {
  const double m = 1 - std::min(std::max(0.0, cos_i), 1.0), m2 = m * m, weight = m2 * m2 * m;
  return static_cast<float>(f0 * (1 - weight) + f90 * weight);
}

}  // namespace

FresnelSplit fresnel_split(float cos_i, float eta) noexcept {
  const auto t = analytic::fresnel_terms<double>(static_cast<double>(cos_i), static_cast<double>(eta));
  return {static_cast<float>(t.reflected), static_cast<float>(t.transmitted), static_cast<float>(t.cos_t)};
}

float fresnel_dielectric(float cos_i, float eta) noexcept { return fresnel_split(cos_i, eta).reflected; }

float schlick(float cos_i, float f0, float f90) noexcept {
  return schlick_of(static_cast<double>(cos_i), static_cast<double>(f0), static_cast<double>(f90));
}

float schlick_f0(float eta) noexcept {
  const double n = static_cast<double>(eta), r = (n - 1) / (n + 1);
  return static_cast<float>(r * r);
}

float schlick_dielectric(float cos_i, float eta) noexcept {
  const double n = static_cast<double>(eta), r = (n - 1) / (n + 1);
  if (eta >= 1) return schlick_of(static_cast<double>(cos_i), r * r, 1);
  const auto t = analytic::fresnel_terms<double>(static_cast<double>(cos_i), n);
  return t.transmitted > 0 ? schlick_of(t.cos_t, r * r, 1) : 1.0f;
}

}  // namespace brdf

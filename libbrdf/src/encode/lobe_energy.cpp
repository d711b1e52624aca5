// SPDX-License-Identifier: Apache-2.0
#include "encode/lobe_energy.h"

#include "container/lobe_quantiser.h"

#include <brdf/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace brdf::encode {
namespace {

constexpr std::array angles{0.0, 30.0, 50.0, 65.0, 75.0, 80.0, 85.0};
constexpr int f90_steps = 16, all_steps = 32;
constexpr double f90_step = 0.7, all_step = 0.9;

double largest_albedo(const LobeSet& lobes) {
  const Material m = Material::from_lobes(lobes).prepare(EvalLevel::fast, true);
  std::vector<float> a(static_cast<std::size_t>(m.channels()));
  double largest = 0;
  for (const double degrees : angles) {
    const double theta = degrees * std::numbers::pi / 180;
    m.albedo(Vec3f(Vec3d(std::sin(theta), 0, std::cos(theta))), a);
    largest = std::max(largest, static_cast<double>(*std::max_element(a.begin(), a.end())));
  }
  return largest;
}

}  // namespace

void bound_lobes(LobeSet& lobes, double limit) {
  for (int i = 0; i < f90_steps + all_steps && largest_albedo(lobes) > limit; ++i)
    for (Lobe& lobe : lobes.lobes) {
      if (container::has_microfacets(lobe.kind)) lobe.f90 *= i < f90_steps ? f90_step : all_step;
      if (i < f90_steps) continue;
      for (double& c : lobe.color) c *= all_step;
    }
}

}  // namespace brdf::encode

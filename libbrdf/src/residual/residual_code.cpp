// SPDX-License-Identifier: Apache-2.0
#include "residual/residual_code.h"

#include <algorithm>
#include <cmath>

namespace brdf::residual {
namespace {

int nearest(double value, double base, double per_octave, int largest) noexcept {
  if (!(value > 0)) return 0;
  return static_cast<int>(std::clamp(std::round(std::log2(value / base) * per_octave), 0.0, static_cast<double>(largest)));
}

}  // namespace

double kappa_h_of(int code) noexcept { return 0.003 * std::exp2(code / 3.0); }
double kappa_d_of(int code) noexcept { return 0.125 * std::exp2(code / 2.0); }
double window_of(int code) noexcept { return 0.02 * std::exp2(code / 2.5); }
double epsilon_of(int code) noexcept { return std::ldexp(1.0, code - 128); }
double step_of(int code) noexcept { return std::exp2(4.0 - code / 8.0); }

int kappa_h_code(double v) noexcept { return nearest(v, 0.003, 3.0, 31); }
int kappa_d_code(double v) noexcept { return nearest(v, 0.125, 2.0, 15); }
int window_code(double v) noexcept { return nearest(v, 0.02, 2.5, 15); }
int epsilon_code(double v) noexcept { return nearest(v, std::ldexp(1.0, -128), 1.0, largest_epsilon_code); }
int step_code(double v) noexcept {
  return static_cast<int>(std::clamp(std::round((4.0 - std::log2(std::max(v, 1e-9))) * 8.0), 0.0, 255.0));
}

}  // namespace brdf::residual

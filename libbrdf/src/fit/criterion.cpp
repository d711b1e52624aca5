// SPDX-License-Identifier: Apache-2.0
#include "fit/criterion.h"

#include <algorithm>
#include <cmath>

namespace brdf::fit {
namespace {

/// Squared log ratio of 1 %: finer than any measurement, so that a table computed from lobes buys no further ones to
/// describe the interpolation between its own cells.
constexpr double loss_floor = 1e-4;

}  // namespace

double information_criterion(double mean_loss, double independent, int parameters) noexcept {
  return independent * std::log(mean_loss + loss_floor) + parameters * std::log(independent);
}

double required_gain(double independent) noexcept {
  return std::max(10.0, 0.05 * independent);  // 10: "very strong" of Kass and Raftery 1995
}

}  // namespace brdf::fit

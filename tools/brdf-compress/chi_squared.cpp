// SPDX-License-Identifier: Apache-2.0
#include "chi_squared.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace brdf::cli {
namespace {

constexpr int most_terms = 10000;
constexpr double precision = 1e-14;

/// exp(-x) x^a / Gamma(a), the common factor of both expansions.
double prefactor(double a, double x) noexcept { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// Regularised lower incomplete gamma function by its series (Abramowitz and Stegun 6.5.29); for x < a + 1.
double lower_gamma_series(double a, double x) noexcept {
  double term = 1 / a, sum = term;
  for (int n = 1; n < most_terms && term > sum * precision; ++n) sum += term *= x / (a + n);
  return sum * prefactor(a, x);
}

/// Regularised upper incomplete gamma function by its continued fraction (Abramowitz and Stegun 6.5.31), evaluated
/// forwards by Lentz's method; for x >= a + 1.
double upper_gamma_fraction(double a, double x) noexcept {
  constexpr double tiny = std::numeric_limits<double>::min() / precision;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int n = 1; n < most_terms; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    const double step = d * c;
    h *= step;
    if (std::abs(step - 1) < precision) break;
  }
  return h * prefactor(a, x);
}

}  // namespace

double chi_squared_tail(double value, double degrees) noexcept {
  if (!(value > 0)) return 1;
  const double a = degrees / 2, x = value / 2;
  return x < a + 1 ? 1 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
}

FitTest chi_squared_test(std::span<const double> observed, std::span<const double> expected, double wanted) {
  struct Bin {
    double observed, expected;
  };
  std::vector<Bin> bins;
  Bin open{0, 0};
  for (std::size_t i = 0; i < observed.size(); ++i) {
    open.observed += observed[i];
    open.expected += expected[i];
    if (open.expected < wanted) continue;
    bins.push_back(open);
    open = {0, 0};
  }
  if (bins.empty()) {
    bins.push_back(open);
  } else {  // what is left joins the last bin
    bins.back().observed += open.observed;
    bins.back().expected += open.expected;
  }
  double sum = 0;
  for (const Bin& bin : bins) {
    const double gap = bin.observed - bin.expected;
    if (bin.expected > 0)
      sum += gap * gap / bin.expected;
    else if (bin.observed > 0)
      sum = std::numeric_limits<double>::infinity();
  }
  FitTest test;
  test.bins = static_cast<int>(bins.size());
  if (test.bins > 1) test.p_value = std::isfinite(sum) ? chi_squared_tail(sum, test.bins - 1) : 0;
  return test;
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "support/chi_squared.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace brdf::test {

namespace {

/// Regularised upper incomplete gamma function Q(a, x): its series below a + 1, else its continued fraction by the
/// modified Lentz method (Press et al. 2007, section 6.2).
double gamma_q(double a, double x) {
  if (x <= 0) return 1;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-16; ++n) sum += term *= x / n;
    return 1 - scale * sum;
  }
  const double tiny = 1e-300;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::fabs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::fabs(c) < tiny) c = tiny;
    d = 1 / d;
    const double step = d * c;
    h *= step;
    if (std::fabs(step - 1) < 1e-15) break;
  }
  return scale * h;
}

}  // namespace

double chi_squared_tail(double statistic, int degrees_of_freedom) {
  return gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

double chi_squared_p_value(std::span<const double> observed, std::span<const double> expected, double least_expected) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double statistic = 0, pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto close = [&] {
    const double difference = pooled_observed - pooled_expected;
    statistic += difference * difference / pooled_expected;
    pooled_observed = pooled_expected = 0;
    ++cells;
  };
  for (std::size_t i : order) {
    if (expected[i] < 1e-9 && observed[i] > 0) return 0;
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected >= least_expected) close();
  }
  if (pooled_expected > 0) close();
  return cells < 2 ? 1 : chi_squared_tail(statistic, cells - 1);
}

double sidak_threshold(double level, int tests) { return 1 - std::pow(1 - level, 1.0 / tests); }

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// Goodness of fit of a histogram.
#pragma once

#include <span>

namespace brdf::test {

/// Upper tail of the chi-squared distribution: the chance of a statistic at least this large.
double chi_squared_tail(double statistic, int degrees_of_freedom);

/// p-value of Pearson's test. Cells with fewer than `least_expected` are pooled, in order of expectation. Observations in
/// cells that expect nothing at all (below 1e-9) give 0.
double chi_squared_p_value(std::span<const double> observed, std::span<const double> expected, double least_expected = 8);

/// Smallest p-value that one of `tests` independent tests may have at the given level for all (Sidak 1967).
double sidak_threshold(double level, int tests);

}  // namespace brdf::test

// SPDX-License-Identifier: Apache-2.0
// What decides how many lobes the data require.
#pragma once

namespace brdf::fit {

/// Bayesian information criterion (Schwarz 1978) of a mean squared log ratio: n log(mean_loss) + k log n. Lower is
/// better. `independent` is the number of samples that count as independent evidence, not of those evaluated.
double information_criterion(double mean_loss, double independent, int parameters) noexcept;

/// By how much a lobe has to lower the criterion beyond its own parameters to be worth its bytes and its share of every
/// evaluation: the mean squared log ratio must fall by a twentieth, and never by less than strong evidence.
double required_gain(double independent) noexcept;

}  // namespace brdf::fit

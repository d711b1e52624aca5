// SPDX-License-Identifier: Apache-2.0
// The reported error as a quadratic form in the coefficients: E(a) = sum over channels of a^t G a - 2 b^t a + c.
#pragma once

#include "encode/bins.h"
#include "encode/distortion.h"
#include "metrics/queries.h"
#include "residual/channel_transform.h"
#include "residual/coefficient_order.h"

#include <brdf/measurement.h>

#include <span>
#include <vector>

namespace brdf::encode {

/// G is shared by all channels; b and the constant are per transformed channel.
struct ErrorModel {
  std::size_t size = 0;                  ///< coefficients
  std::vector<double> gram;              ///< size x size, symmetric
  std::vector<std::vector<double>> b;    ///< [channel][size]
  double constant = 0;                   ///< E(0)
};

/// The diagonal (per cell) part. Exact for the cells: products of cosines are sums of cosines, so the whole matrix follows
/// from transforms of the weights and no basis function is ever tabulated over the cells.
ErrorModel cell_model(const Bins& bins, std::span<const double> weights, const residual::Basis& basis,
                      std::span<const residual::Frequency> order, residual::ChannelTransform transform);

/// Adds the image under an environment: errors add up over the lights before they are seen.
void add_environment(ErrorModel& model, const Measurement& m, const LobeSet& lobes, const metrics::QuerySet& queries,
                     const residual::Basis& basis, std::span<const residual::Frequency> order,
                     residual::ChannelTransform transform, double weight);

/// E(a) for all channels.
double model_error(const ErrorModel& model, const std::vector<std::vector<double>>& a);

}  // namespace brdf::encode

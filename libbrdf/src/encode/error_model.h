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
  std::vector<double> gram;              ///< size x size, symmetric; empty when `diagonal` is all there is
  std::vector<double> diagonal;          ///< for models too large for a matrix
  std::vector<std::vector<double>> b;    ///< [channel][size]
  double constant = 0;                   ///< E(0)
};

/// The diagonal (per cell) part. Exact for the cells: products of cosines are sums of cosines, so the whole matrix follows
/// from transforms of the weights and no basis function is ever tabulated over the cells.
ErrorModel cell_model(const Bins& bins, std::span<const double> weights, const residual::Basis& basis,
                      residual::Azimuth azimuth, std::span<const residual::Frequency> order, residual::ChannelTransform transform);

/// What an image under the environment shows: f at its rows, and the slope of the display curve per unit of light at its
/// pixels, [row or pixel][channel]. No slopes when the material is black.
struct ImageSlopes {
  std::vector<double> f, slope;
};
ImageSlopes image_slopes(const Measurement& m, const metrics::QuerySet& queries);

/// Adds the image under an environment: errors add up over the lights before they are seen.
void add_environment(ErrorModel& model, const ImageSlopes& shown, const LobeSet& lobes, const metrics::QuerySet& queries,
                     const residual::Basis& basis, residual::Azimuth azimuth, std::span<const residual::Frequency> order,
                     residual::ChannelTransform transform, double weight);

/// Adds scale * (row . a - target)^2 for rows of `model.size` numbers; targets [row][channel] before the channel transform.
void add_rows(ErrorModel& model, std::span<const double> rows, std::span<const double> targets,
              const std::vector<double>& channel_matrix, double scale);

/// E(a) for all channels.
double model_error(const ErrorModel& model, const std::vector<std::vector<double>>& a);

}  // namespace brdf::encode

// SPDX-License-Identifier: Apache-2.0
// The reported error as a quadratic form in the coefficients of a residual in slice coordinates.
#pragma once

#include "encode/bins.h"
#include "encode/error_model.h"
#include "encode/slice_samples.h"
#include "metrics/queries.h"

#include <span>
#include <vector>

namespace brdf::encode {

/// Weights of cells (distortion.h), spread over the nodes that evaluation reads there.
std::vector<double> slice_weights(const Bins& bins, std::span<const double> cell_weights, const residual::Basis& basis,
                                  const residual::SliceFrame& frame, const SliceSamples& samples);

/// Diagonal in the nodes; the matrix follows from transforms of the weights.
ErrorModel slice_model(const SliceSamples& samples, std::span<const double> weights, std::span<const residual::Frequency> order,
                       residual::ChannelTransform transform);

/// For very many coefficients: what each costs by itself. The cosines are orthogonal over the nodes, so that only the
/// differences between the weights of nodes are lost.
ErrorModel slice_diagonal(const SliceSamples& samples, std::span<const double> weights, std::span<const residual::Frequency> order,
                          const std::vector<std::vector<double>>& coefficients);

/// Adds the image under an environment, linear in the nodes around what was measured.
void add_environment(ErrorModel& model, const ImageSlopes& image, const SliceSamples& samples, const residual::SliceFrame& frame,
                     const metrics::QuerySet& queries, std::span<const residual::Frequency> order,
                     residual::ChannelTransform transform, double weight);

/// Coefficients whose cosines pass through the samples, cut to the order. [transformed channel][coefficient].
std::vector<std::vector<double>> slice_coefficients(const SliceSamples& samples, std::span<const residual::Frequency> order,
                                                    residual::ChannelTransform transform);

}  // namespace brdf::encode

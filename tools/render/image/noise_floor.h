// SPDX-License-Identifier: Apache-2.0
// What Monte Carlo noise does to the difference of two renders, estimated from two independent halves of their samples.
#pragma once

#include "image/plane.h"

namespace brdf::render {

/// The two halves of the samples behind a reference and a candidate: reference = (reference_a + reference_b) / 2, and so the
/// candidate. The halves `a` and `b` are independent (different seeds) and have equally many samples. `candidate_a` may share its
/// random numbers with `reference_a`, and `candidate_b` with `reference_b`.
struct NoisePair {
  Image reference_a, reference_b, candidate_a, candidate_b;
};

/// The noise of the whole difference, drawn once more. With d_a and d_b the differences candidate - reference of the halves,
/// the difference of the whole pictures is d = (d_a + d_b) / 2. The answer is n = (d_a - d_b) / 2: at every pixel it has the same
/// variance as d but no mean, and it is not correlated with d, because the halves are independent and alike. What common
/// random numbers cancel in d_a and d_b is not in n. Throws Error invalid_argument (sizes).
Image noise_of_difference(const NoisePair& noise);

/// A mean of squares from which the noise's share is taken, and the standard deviation that chance alone gives it.
struct WithoutNoise {
  double value = 0;  ///< negative by chance where nothing is there
  double deviation = 0;
};

/// Mean over pixels and channels of (d^2 - n^2) weight, which is d_a d_b weight. As the halves are independent its expectation
/// is the squared difference without noise; a weight that is computed from noisy pictures adds a bias of the order of
/// that noise times the difference. `deviation` counts pixels as independent and the three channels of a pixel, which share their
/// paths, as one; it is exact where there is no difference, and too large otherwise. An empty `weight` is 1 everywhere.
WithoutNoise squares_without_noise(const Image& difference, const Image& noise, const Image& weight = {});

/// The standard deviation of the mean of a difference over pixels and channels, whose noise is `noise`; pixels as independent.
double deviation_of_mean(const Image& noise);

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
#include "image/differences.h"
#include "image/noise_floor.h"

#include <cmath>

namespace brdf::render {

Image noise_of_difference(const NoisePair& noise) {
  const Image a = difference(noise.reference_a, noise.candidate_a), b = difference(noise.reference_b, noise.candidate_b);
  Image result = difference(b, a);
  for (Vec3f& pixel : result.pixels) pixel *= 0.5F;
  return result;
}

WithoutNoise squares_without_noise(const Image& difference, const Image& noise, const Image& weight) {
  check_same_size(difference, noise);
  if (!weight.pixels.empty()) check_same_size(difference, weight);
  double sum = 0, sum_of_squares = 0;
  for (std::size_t i = 0; i < difference.pixels.size(); ++i) {
    const Vec3d d(difference.pixels[i]), n(noise.pixels[i]), w = weight.pixels.empty() ? Vec3d(1) : Vec3d(weight.pixels[i]);
    const Vec3d terms = (d * d - n * n) * w;
    const double term = terms.x + terms.y + terms.z;
    sum += term;
    // Without a difference d and n are alike, so the terms have mean zero and their squares add up to the sum's variance.
    sum_of_squares += term * term;
  }
  const double count = 3 * static_cast<double>(difference.pixels.size());
  return {sum / count, std::sqrt(sum_of_squares) / count};
}

double deviation_of_mean(const Image& noise) {
  double sum = 0;
  for (const Vec3f& n : noise.pixels) {
    const double pixel = (static_cast<double>(n.x) + static_cast<double>(n.y) + static_cast<double>(n.z)) / 3;
    sum += pixel * pixel;
  }
  return noise.pixels.empty() ? 0 : std::sqrt(sum) / static_cast<double>(noise.pixels.size());
}

}  // namespace brdf::render

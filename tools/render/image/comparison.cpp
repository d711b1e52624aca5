// SPDX-License-Identifier: Apache-2.0
#include "image/comparison.h"
#include "image/differences.h"
#include "image/display.h"
#include "image/flip.h"
#include "image/ssim.h"

#include <cmath>

namespace brdf::render {
namespace {

Image sum(const Image& a, const Image& b) {
  Image result = a;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] += b.pixels[i];
  return result;
}

/// What relative_mse divides by, as factors of the squared radiance's difference.
Image relative_weights(const Image& reference, float stops) {
  const double factor = std::exp2(static_cast<double>(stops));
  Image weights = reference;
  for (Vec3f& pixel : weights.pixels) {
    for (int c = 0; c < 3; ++c) {
      const double level = factor * static_cast<double>(pixel[c]);
      pixel[c] = static_cast<float>(factor * factor / (level * level + relative_mse_offset));
    }
  }
  return weights;
}

void add_floors(ComparisonResult& result, const Image& reference, const Image& candidate, const Image& noise, float stops) {
  const Image noisy = sum(reference, noise);
  result.psnr.floor = psnr(reference, noisy, stops);
  result.ssim.floor = ssim(reference, noisy, stops);
  result.flip.floor = mean(flip(exposed(reference, stops), exposed(noisy, stops)));
  result.hdr_flip.floor = mean(hdr_flip(reference, noisy));
  result.relative_mse.floor = relative_mse(reference, noisy, stops);
  const RadianceDifference radiance = radiance_difference(reference, noisy);
  result.mse.floor = radiance.mean_squared;
  result.max_difference.floor = radiance.max_absolute;
  result.mean_absolute.floor = radiance.mean_absolute;
  result.mean_signed_deviation = deviation_of_mean(noise);

  result.mse_without_noise = squares_without_noise(result.difference, noise);
  result.relative_mse_without_noise = squares_without_noise(result.difference, noise, relative_weights(reference, stops));
  const Image shown = displayed(reference, stops);
  result.displayed_mse_without_noise = squares_without_noise(difference(shown, displayed(candidate, stops)),
                                                             difference(shown, displayed(noisy, stops)));
}

}  // namespace

ComparisonResult compare_images(const Image& reference, const Image& candidate, const std::optional<NoisePair>& noise,
                                float exposure_stops) {
  ComparisonResult result;
  result.difference = difference(reference, candidate);
  result.psnr.value = psnr(reference, candidate, exposure_stops);
  result.ssim.value = ssim(reference, candidate, exposure_stops);
  result.flip_map = flip(exposed(reference, exposure_stops), exposed(candidate, exposure_stops));
  result.flip.value = mean(result.flip_map);
  result.hdr_flip.value = mean(hdr_flip(reference, candidate));
  result.relative_mse.value = relative_mse(reference, candidate, exposure_stops);
  const RadianceDifference radiance = radiance_difference(reference, candidate);
  result.mse.value = radiance.mean_squared;
  result.max_difference.value = radiance.max_absolute;
  result.mean_absolute.value = radiance.mean_absolute;
  result.mean_signed = radiance.mean_signed;
  if (noise) {
    const Image drawn = noise_of_difference(*noise);
    check_same_size(reference, drawn);
    add_floors(result, reference, candidate, drawn, exposure_stops);
  }
  return result;
}

}  // namespace brdf::render

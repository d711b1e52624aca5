// SPDX-License-Identifier: Apache-2.0
#include "image/differences.h"
#include "image/display.h"
#include "image/plane.h"

#include <algorithm>
#include <cmath>

namespace brdf::render {
namespace {

/// Mean of `term(reference value, candidate value)` over pixels and channels.
template <class Term>
double mean_over_values(const Image& reference, const Image& candidate, Term&& term) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      sum += term(static_cast<double>(reference.pixels[i][c]), static_cast<double>(candidate.pixels[i][c]));
    }
  }
  return sum / (3 * static_cast<double>(reference.pixels.size()));
}

}  // namespace

double displayed_mse(const Image& reference, const Image& candidate, float exposure_stops) {
  check_same_size(reference, candidate);
  return mean_over_values(displayed(reference, exposure_stops), displayed(candidate, exposure_stops),
                          [](double r, double c) { return (c - r) * (c - r); });
}

double psnr_of(double mean_squared_difference) noexcept {
  return mean_squared_difference > 0 ? std::min(psnr_cap, -10 * std::log10(mean_squared_difference)) : psnr_cap;
}

double psnr(const Image& reference, const Image& candidate, float exposure_stops) {
  return psnr_of(displayed_mse(reference, candidate, exposure_stops));
}

double relative_mse(const Image& reference, const Image& candidate, float exposure_stops) {
  check_same_size(reference, candidate);
  const double factor = std::exp2(static_cast<double>(exposure_stops));
  return mean_over_values(reference, candidate, [&](double r, double c) {
    const double error = factor * (c - r), level = factor * r;
    return error * error / (level * level + relative_mse_offset);
  });
}

RadianceDifference radiance_difference(const Image& reference, const Image& candidate) {
  check_same_size(reference, candidate);
  RadianceDifference result;
  result.mean_absolute = mean_over_values(reference, candidate, [&](double r, double c) {
    result.max_absolute = std::max(result.max_absolute, std::abs(c - r));
    return std::abs(c - r);
  });
  result.mean_squared = mean_over_values(reference, candidate, [](double r, double c) { return (c - r) * (c - r); });
  result.mean_signed = mean_over_values(reference, candidate, [](double r, double c) { return c - r; });
  return result;
}

Image difference(const Image& reference, const Image& candidate) {
  check_same_size(reference, candidate);
  Image result = candidate;
  for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= reference.pixels[i];
  return result;
}

}  // namespace brdf::render

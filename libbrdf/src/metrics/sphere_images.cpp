// SPDX-License-Identifier: Apache-2.0
#include "metrics/sphere_images.h"

#include <algorithm>
#include <cmath>

namespace brdf::metrics {
namespace {

constexpr double display_gamma = 2.2, mean_grey = 0.5;

double displayed(double value, double exposure) noexcept {
  return std::pow(std::clamp(value * exposure, 0.0, 1.0), 1 / display_gamma);
}

}  // namespace

SphereImages::SphereImages(const QuerySet& set, int channel_count) : channels(channel_count) {
  for (std::size_t k = 0; k < pixels.size(); ++k)
    pixels[k].assign(std::size_t{set.image[k].pixels} * static_cast<std::size_t>(channel_count), 0.0);
}

void SphereImages::add(const QuerySet& set, std::size_t first, std::size_t count, std::span<const float> f) noexcept {
  std::size_t k = 0;
  while (first >= set.image[k].first + set.image[k].rows) ++k;
  const auto n = static_cast<std::size_t>(channels);
  for (std::size_t i = 0; i < count; ++i) {
    double* pixel = &pixels[k][set.pixel[first + i] * n];
    for (std::size_t c = 0; c < n; ++c)
      pixel[c] += static_cast<double>(f[i * n + c]) * set.gain(first + i, static_cast<int>(c), channels);
  }
}

double psnr(std::span<const double> reference, std::span<const double> candidate) noexcept {
  const auto n = static_cast<double>(reference.size());
  double mean = 0, squares = 0;
  for (const double v : reference) mean += v;
  const double exposure = mean_grey / std::max(mean / n, 1e-12);
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double d = displayed(reference[i], exposure) - displayed(candidate[i], exposure);
    squares += d * d;
  }
  return std::min(psnr_cap, -10 * std::log10(std::max(squares / n, 1e-12)));
}

}  // namespace brdf::metrics

// SPDX-License-Identifier: Apache-2.0
#include "image/flip.h"
#include "image/luminance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brdf::render {
namespace {

/// Narkowicz's fit of the ACES tone curve (2015), x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), of 0.6 times the radiance as
/// its author recommends: (p2 x^2 + p1 x) / (q2 x^2 + q1 x + q0).
struct ToneCurve {
  double p2 = 0.36 * 2.51, p1 = 0.6 * 0.03, q2 = 0.36 * 2.43, q1 = 0.6 * 0.59, q0 = 0.14;
  double operator()(double x) const noexcept { return std::clamp((p2 * x * x + p1 * x) / (q2 * x * x + q1 * x + q0), 0.0, 1.0); }
  /// The x that is shown as `level`: the positive root of (p2 - level q2) x^2 + (p1 - level q1) x - level q0.
  double inverse(double level) const noexcept {
    const double a = p2 - level * q2, b = p1 - level * q1, c = -level * q0;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }
};

Image tone_mapped(const Image& image, double stops) {
  const ToneCurve curve;
  const double factor = std::exp2(stops);
  Image result(image.width, image.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const float radiance = image.pixels[i][c];
      result.pixels[i][c] = radiance > 0 ? static_cast<float>(curve(factor * static_cast<double>(radiance))) : 0.0F;
    }
  }
  return result;
}

}  // namespace

FlipExposures flip_exposures(const Image& reference) {
  std::vector<float> luminances;
  luminances.reserve(reference.pixels.size());
  for (const Vec3f& pixel : reference.pixels) luminances.push_back(luminance(pixel));
  if (luminances.empty()) return {};
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);  // the upper of two
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double median = static_cast<double>(*middle);
  const double brightest = static_cast<double>(*std::max_element(middle, luminances.end()));
  if (!(brightest > 0)) return {};  // a black picture looks the same at every exposure
  const double bright = ToneCurve().inverse(0.85);
  // A median of zero asks for an exposure without end.
  const double smallest = static_cast<double>(std::numeric_limits<float>::epsilon());
  FlipExposures exposures;
  exposures.start = std::log2(bright / brightest);
  exposures.stop = std::log2(bright / std::max(median, smallest));
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

Plane hdr_flip(const Image& reference, const Image& candidate, double pixels_per_degree) {
  check_same_size(reference, candidate);
  const FlipExposures exposures = flip_exposures(reference);
  Plane map(reference.width, reference.height);
  for (int i = 0; i < exposures.count; ++i) {
    const double stops = exposures.start + (exposures.stop - exposures.start) * i / (exposures.count - 1);
    const Plane at_exposure = flip(tone_mapped(reference, stops), tone_mapped(candidate, stops), pixels_per_degree);
    for (std::size_t p = 0; p < map.values.size(); ++p) map.values[p] = std::max(map.values[p], at_exposure.values[p]);
  }
  return map;
}

}  // namespace brdf::render

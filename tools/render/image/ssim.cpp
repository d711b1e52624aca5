// SPDX-License-Identifier: Apache-2.0
#include "image/display.h"
#include "image/luminance.h"
#include "image/ssim.h"

#include <brdf/error.h>

#include <array>
#include <cmath>
#include <string>

namespace brdf::render {
namespace {

constexpr int radius = ssim_window / 2;

std::array<float, ssim_window> gaussian() {
  constexpr double deviation = 1.5;
  std::array<double, ssim_window> weights{};
  double sum = 0;
  for (int i = 0; i < ssim_window; ++i) {
    const double x = (i - radius) / deviation;
    sum += weights[static_cast<std::size_t>(i)] = std::exp(-x * x / 2);
  }
  std::array<float, ssim_window> kernel{};
  for (std::size_t i = 0; i < kernel.size(); ++i) kernel[i] = static_cast<float>(weights[i] / sum);
  return kernel;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
  return result;
}

Plane luma(const Image& image, float exposure_stops) {
  const Image shown = displayed(image, exposure_stops);
  Plane plane(image.width, image.height);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = luminance(shown.pixels[i]);
  return plane;
}

}  // namespace

double ssim(const Plane& a, const Plane& b) {
  if (a.width != b.width || a.height != b.height || a.width < ssim_window || a.height < ssim_window) {
    throw Error(ErrorCode::invalid_argument, "SSIM needs two pictures of one size, at least " + std::to_string(ssim_window) + " x " +
                                                 std::to_string(ssim_window) + " pixels, and these have " +
                                                 std::to_string(a.width) + " x " + std::to_string(a.height) + " and " +
                                                 std::to_string(b.width) + " x " + std::to_string(b.height));
  }
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // (K L)^2 with L = 1
  const std::array<float, ssim_window> kernel = gaussian();
  const auto windowed = [&](const Plane& plane) { return filtered(plane, kernel, kernel); };
  const Plane mean_a = windowed(a), mean_b = windowed(b);
  const Plane square_a = windowed(product(a, a)), square_b = windowed(product(b, b)), cross = windowed(product(a, b));
  double sum = 0;
  for (int y = radius; y < a.height - radius; ++y) {
    for (int x = radius; x < a.width - radius; ++x) {
      const double ma = static_cast<double>(mean_a.at(x, y)), mb = static_cast<double>(mean_b.at(x, y));
      const double var_a = static_cast<double>(square_a.at(x, y)) - ma * ma;
      const double var_b = static_cast<double>(square_b.at(x, y)) - mb * mb;
      const double covariance = static_cast<double>(cross.at(x, y)) - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (var_a + var_b + c2));  // eq. 13
    }
  }
  return sum / (static_cast<double>(a.width - 2 * radius) * (a.height - 2 * radius));
}

double ssim(const Image& reference, const Image& candidate, float exposure_stops) {
  check_same_size(reference, candidate);
  return ssim(luma(reference, exposure_stops), luma(candidate, exposure_stops));
}

}  // namespace brdf::render

// SPDX-License-Identifier: Apache-2.0
// The images of the sphere: linear radiance per pixel, and how two of them compare.
#pragma once

#include "metrics/queries.h"

#include <span>

namespace brdf::metrics {

inline constexpr double psnr_cap = 60;  ///< dB; a perfect image must not outweigh the others in a mean

struct SphereImages {
  int channels = 0;
  std::array<std::vector<double>, image_names.size()> pixels;  ///< pixel * channels + c, of lit pixels

  SphereImages(const QuerySet& set, int channel_count);

  /// Adds rows [first, first + count), all of one image. Threads may add different pixels at once.
  void add(const QuerySet& set, std::size_t first, std::size_t count, std::span<const float> f) noexcept;
};

/// PSNR in dB of displayed values clip(e x, 0, 1)^(1/2.2), e = 0.5 / mean(reference), over pixels and channels, at most
/// `psnr_cap`.
double psnr(std::span<const double> reference, std::span<const double> candidate) noexcept;

}  // namespace brdf::metrics

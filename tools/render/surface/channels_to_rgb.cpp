// SPDX-License-Identifier: Apache-2.0
#include "surface/channels_to_rgb.h"

#include <brdf/error.h>

#include <cmath>
#include <glm/mat3x3.hpp>
#include <string>

namespace brdf::render {
namespace {

/// XYZ of D65 to linear RGB, IEC 61966-2-1; columns as glm has them.
const glm::dmat3 rgb_of_xyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252);

/// Bradford's adaptation from illuminant E, whose white is (1, 1, 1), to D65 (Lindbloom's table).
const glm::dmat3 d65_of_e(0.9531874, -0.0382467, 0.0026068, -0.0265906, 1.0288406, -0.0030332, 0.0238731, 0.0094060, 1.0892565);

double lobe(double x, double centre, double below, double above) noexcept {
  const double t = (x - centre) / (x < centre ? below : above);
  return std::exp(-0.5 * t * t);
}

std::vector<Vec3f> spectral_columns(const std::vector<float>& nm) {
  const std::size_t n = nm.size();
  std::vector<Vec3d> columns(n);
  Vec3d white(0);
  for (std::size_t i = 0; i < n; ++i) {
    // the trapezoidal rule on any ascending wavelengths: half the gap on either side
    const double low = nm[i > 0 ? i - 1 : i], high = nm[i + 1 < n ? i + 1 : i];
    const double width = n > 1 ? 0.5 * (high - low) : 1.0;
    columns[i] = rgb_of_xyz * (d65_of_e * (colour_matching(nm[i]) * width));
    white += columns[i];
  }
  const bool is_visible = white.x > 0 && white.y > 0 && white.z > 0;
  std::vector<Vec3f> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    // wavelengths that cover no colour have no hue to show: their mean is shown as grey
    result[i] = is_visible ? Vec3f(columns[i] / white) : Vec3f(1.0f / static_cast<float>(n));
  }
  return result;
}

}  // namespace

Vec3d colour_matching(double nm) noexcept {
  return {1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
          0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
          1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

ChannelsToRgb::ChannelsToRgb(const Channels& channels) : channels_(channels.count) {
  const auto count = static_cast<std::size_t>(channels.count);
  if (channels.model == ChannelModel::spectral) {
    if (channels.wavelengths_nm.size() != count) {
      throw Error(ErrorCode::invalid_argument, "a spectral material has " + std::to_string(count) + " channels and " +
                                                   std::to_string(channels.wavelengths_nm.size()) + " wavelengths");
    }
    columns_ = spectral_columns(channels.wavelengths_nm);
  } else if (channels.model == ChannelModel::xyz && count == 3) {
    for (int c = 0; c < 3; ++c) columns_.push_back(Vec3f(rgb_of_xyz[c]));
  } else if (channels.model != ChannelModel::rgb || count != 3) {
    columns_.assign(count, Vec3f(1.0f / static_cast<float>(count)));
  }
}

}  // namespace brdf::render

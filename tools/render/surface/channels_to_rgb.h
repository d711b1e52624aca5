// SPDX-License-Identifier: Apache-2.0
// Channels of any material as linear sRGB.
#pragma once

#include <brdf/measurement.h>

#include <algorithm>
#include <span>
#include <vector>

namespace brdf::render {

/// A linear map from channels to RGB. RGB stays as it is, one channel becomes grey, XYZ is multiplied by the inverse of BT.709's
/// matrix; a spectrum is integrated against the colour matching functions of the CIE 1931 observer (Wyman, Sloan and
/// Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", eq. 4: multi-lobe fits) under
/// an equal-energy illuminant, and adapted to D65 (Bradford), so that a perfect white becomes (1, 1, 1).
/// Thread-safe, never allocates after construction.
class ChannelsToRgb {
 public:
  ChannelsToRgb() = default;
  /// Throws Error(invalid_argument) when the number of wavelengths is not that of the channels.
  explicit ChannelsToRgb(const Channels& channels);

  bool is_identity() const noexcept { return columns_.empty(); }
  int channels() const noexcept { return channels_; }
  /// Colours outside the gamut are clipped to 0: reflectance below 0 would make light of nothing elsewhere.
  template <class Float>
  Vec3f operator()(std::span<const Float> values) const noexcept {
    const Vec3f rgb = unclipped(values);
    return is_identity() ? rgb : Vec3f(std::max(rgb.x, 0.0f), std::max(rgb.y, 0.0f), std::max(rgb.z, 0.0f));
  }
  /// The map itself.
  template <class Float>
  Vec3f unclipped(std::span<const Float> values) const noexcept {
    if (is_identity()) return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
    Vec3f rgb(0);
    for (std::size_t c = 0; c < columns_.size(); ++c) rgb += columns_[c] * static_cast<float>(values[c]);
    return rgb;
  }

 private:
  int channels_ = 3;
  std::vector<Vec3f> columns_;  ///< of the matrix, one per channel; none: identity
};

/// The fitted colour matching functions at a wavelength.
Vec3d colour_matching(double wavelength_nm) noexcept;

}  // namespace brdf::render

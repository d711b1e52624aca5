// SPDX-License-Identifier: Apache-2.0
// A measured file as a renderer uses it: the table itself for values, and a small compressed copy of it for directions.
#pragma once

#include "surface/channels_to_rgb.h"

#include <brdf/material.h>
#include <brdf/measurement.h>

namespace brdf::render {

/// Immutable and thread-safe; the evaluation never allocates.
///
/// Where the table has no measurement, near grazing angles most of all, the compressed copy answers: black would be wrong
/// as well, and would draw a dark rim around every object.
class MeasuredTable {
 public:
  /// Compresses a copy at effort 0, which takes some seconds. Throws Error: unsupported (more than max_channels), no_data and
  /// what `compress` throws.
  ///
  /// `exchanged`: light and viewer change places in every look-up. Measured data need not be reciprocal, and other programs take
  /// the file's incident direction for the viewer's.
  explicit MeasuredTable(Measurement measurement, bool exchanged = false);

  static constexpr std::size_t max_channels = 1024;

  /// f in 1/sr, as RGB.
  Vec3f eval(const Vec3f& wi, const Vec3f& wo) const noexcept;
  /// Draws directions well for this table. Sampling is unbiased for any density that is nowhere 0.
  const Material& proxy() const noexcept { return proxy_; }
  const Measurement& measurement() const noexcept { return measurement_; }

 private:
  Measurement measurement_;
  MeasurementInterpolator interpolator_;
  ChannelsToRgb rgb_;
  Material proxy_;
  bool exchanged_;
};

/// RGB of a material's channels, without allocation.
Vec3f eval_rgb(const Material& material, const ChannelsToRgb& rgb, const Vec3f& wi, const Vec3f& wo) noexcept;

}  // namespace brdf::render

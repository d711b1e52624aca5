// SPDX-License-Identifier: Apache-2.0
#include "surface/measured_table.h"

#include <brdf/encode.h>
#include <brdf/error.h>

#include <array>
#include <string>

namespace brdf::render {
namespace {

Material compressed_copy(const Measurement& measurement) {
  if (const int count = measurement.channels.count; count > static_cast<int>(MeasuredTable::max_channels)) {
    throw Error(ErrorCode::unsupported, measurement.provenance.name + ": " + std::to_string(count) + " channels, at most " +
                                            std::to_string(MeasuredTable::max_channels) + " can be rendered");
  }
  EncodeOptions options;
  options.effort = 0;
  return Material::decode(compress(measurement, options).bytes);
}

}  // namespace

MeasuredTable::MeasuredTable(Measurement measurement, bool exchanged)
    : measurement_(std::move(measurement)),
      interpolator_(measurement_),
      rgb_(measurement_.channels),
      proxy_(compressed_copy(measurement_)),
      exchanged_(exchanged) {}

Vec3f MeasuredTable::eval(const Vec3f& towards_light, const Vec3f& towards_viewer) const noexcept {
  const Vec3f& wi = exchanged_ ? towards_viewer : towards_light;
  const Vec3f& wo = exchanged_ ? towards_light : towards_viewer;
  std::array<double, max_channels> values;
  const std::span<double> used = std::span(values).first(static_cast<std::size_t>(rgb_.channels()));
  if (interpolator_.eval(Vec3d(wi), Vec3d(wo), used)) return rgb_(std::span<const double>(used));
  return eval_rgb(proxy_, rgb_, wi, wo);
}

Vec3f eval_rgb(const Material& material, const ChannelsToRgb& rgb, const Vec3f& wi, const Vec3f& wo) noexcept {
  if (rgb.is_identity()) {
    Vec3f f;
    material.eval(wi, wo, std::span<float>(&f.x, 3));
    return f;
  }
  std::array<float, MeasuredTable::max_channels> values;
  const std::span<float> used = std::span(values).first(static_cast<std::size_t>(rgb.channels()));
  material.eval(wi, wo, used);
  return rgb(std::span<const float>(used));
}

}  // namespace brdf::render

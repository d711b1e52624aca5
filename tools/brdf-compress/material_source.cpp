// SPDX-License-Identifier: Apache-2.0
#include "material_source.h"

#include "compressed_file.h"
#include "direction_planes.h"
#include "input_file.h"

#include <algorithm>

namespace brdf::cli {

MaterialSource MaterialSource::open(const std::filesystem::path& path, const SourceOptions& options) {
  MaterialSource source;
  source.path_ = path.string();
  std::vector<std::byte> bytes = read_input(path);
  source.file_bytes_ = bytes.size();
  if (sniff(bytes, bytes.size()) == FileFormat::brdfc) {
    source.bytes_ = cut_to_prefix(std::move(bytes), options.prefix, source.path_);
    source.material_ = decode_file(source.bytes_, options.level, options.prefix.has_value(), source.path_, true);
    return source;
  }
  IngestOptions ingest;
  ingest.position = options.position;
  source.measurement_ = std::make_shared<const Measurement>(read_measurement(bytes, source.path_, ingest));
  source.interpolator_ = std::make_shared<const MeasurementInterpolator>(*source.measurement_);
  return source;
}

const Channels& MaterialSource::channels() const noexcept {
  return material_ ? material_->info().channels : measurement_->channels;
}

bool MaterialSource::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept {
  if (!material_) return interpolator_->eval(wi, wo, f);
  constexpr std::size_t most = DecodeLimits{}.max_channels;
  thread_local std::vector<float> values(most);
  const std::span<float> used = std::span(values).first(f.size());
  material_->eval(Vec3f(wi), Vec3f(wo), used);
  std::copy(used.begin(), used.end(), f.begin());
  return true;
}

BatchEval MaterialSource::rows() const {
  if (material_) return batch_rows(*material_);
  // The interpolator refers to the measurement, so both are held.
  return [measurement = measurement_, rows = batch_rows(interpolator_, measurement_->channels.count)](
             std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) { rows(wi, wo, out); };
}

BatchEval batch_rows(const Material& material) {
  return [material](std::span<const Vec3f> wi, std::span<const Vec3f> wo, std::span<float> out) {
    thread_local DirectionPlanes in, view;
    thread_local std::vector<float> values;
    const std::size_t n = wi.size(), channels = static_cast<std::size_t>(material.channels());
    in.assign(wi);
    view.assign(wo);
    values.resize(n * channels);
    material.eval(in.span(), view.span(), {values.data(), n});
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t i = 0; i < n; ++i) out[i * channels + c] = values[c * n + i];
  };
}

BatchEval batch_rows(std::shared_ptr<const MeasurementInterpolator> interpolator, int channels) {
  return [interpolator = std::move(interpolator), channels](std::span<const Vec3f> wi, std::span<const Vec3f> wo,
                                                            std::span<float> out) {
    std::vector<double> f(static_cast<std::size_t>(channels));
    float* to = out.data();
    for (std::size_t i = 0; i < wi.size(); ++i) {
      interpolator->eval(Vec3d(wi[i]), Vec3d(wo[i]), f);
      for (const double v : f) *to++ = static_cast<float>(v);
    }
  };
}

}  // namespace brdf::cli

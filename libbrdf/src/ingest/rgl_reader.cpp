// SPDX-License-Identifier: Apache-2.0
#include "ingest/rgl_reader.h"

#include <brdf/error.h>

#include "ingest/printable_text.h"
#include "ingest/tensor_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::ingest {
namespace {

constexpr std::uint64_t rgb_channels = 3;
constexpr std::uint64_t max_extent = 1u << 24;  // of one axis of a 2-D table: positions stay exact in a float

Error malformed(const TensorFile& file, const TensorField& field, const std::string& what) {
  return {ErrorCode::malformed, file.name() + ": field " + in_quotes(field.name) + " " + what};
}

void refuse_what_is_not_read_yet(const TensorFile& file) {
  if (file.find("rgb")) return;
  if (const TensorField* wavelengths = file.find("wavelengths"); wavelengths || file.find("spectra")) {
    throw Error(ErrorCode::unsupported,
                file.name() + ": holds spectra" +
                    (wavelengths ? " of " + std::to_string(wavelengths->count) + " wavelengths" : std::string()) +
                    ", which this version does not read; use the '_rgb' file of the same material");
  }
  if (file.find("wvls") && file.find("M")) {
    throw Error(ErrorCode::unsupported,
                file.name() + ": holds polarimetric Mueller matrices, which this version does not read");
  }
  throw Error(ErrorCode::malformed, file.name() + ": is a tensor file without a field 'rgb', so no RGB material");
}

void refuse_anisotropic(const TensorFile& file) {
  const TensorField& phi = file.require("phi_i", TensorType::f32, 1);
  if (phi.count == 0) throw malformed(file, phi, "is empty, at least one azimuth is needed");
  // the format's own rule: two azimuths still mean an isotropic material
  if (phi.count > 2) {
    throw Error(ErrorCode::unsupported,
                file.name() + ": is anisotropic (field 'phi_i' has " + std::to_string(phi.count) +
                    " azimuths, an isotropic material has 1 or 2), which this version does not read");
  }
}

/// Fields may lie on the same bytes, so that the size of the file says little about the sum of the tables.
void check_memory(const TensorFile& file, const IngestLimits& limits) {
  std::uint64_t values = 0;
  for (const char* name : {"theta_i", "ndf", "sigma", "vndf", "rgb"})
    if (const TensorField* field = file.find(name)) values += std::min(field->count, limits.max_table_values + 1);
  if (const TensorField* rgb = file.find("rgb")) values += std::min(rgb->count, limits.max_table_values + 1);  // reordered
  if (values > limits.max_temporary_bytes / sizeof(float)) {
    throw Error(ErrorCode::limit_exceeded, file.name() + ": reading its tables takes memory for " + std::to_string(values) +
                                               " values of 4 bytes, the limit is " +
                                               std::to_string(limits.max_temporary_bytes) + " bytes");
  }
}

std::vector<float> read_elevations(const TensorFile& file) {
  const TensorField& field = file.require("theta_i", TensorType::f32, 1);
  if (field.count == 0) throw malformed(file, field, "is empty, at least one elevation is needed");
  std::vector<float> theta = file.read_floats(field);
  constexpr double last = std::numbers::pi / 2 + 1e-3;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    if (double{theta[i]} < 0 || double{theta[i]} > last) {
      throw malformed(
          file, field,
          "is " + std::to_string(theta[i]) + " at index " + std::to_string(i) + ", allowed are 0 to pi/2 radians");
    }
    if (i > 0 && theta[i] <= theta[i - 1]) {
      throw malformed(file, field,
                      "does not ascend at index " + std::to_string(i) + ": " + std::to_string(theta[i]) + " follows " +
                          std::to_string(theta[i - 1]));
    }
  }
  return theta;
}

/// The last two extents of a field as height and width.
void read_resolution(const TensorFile& file, const TensorField& field, int& height, int& width) {
  const std::uint64_t h = field.shape[field.shape.size() - 2], w = field.shape.back();
  if (h < 2 || w < 2 || h > max_extent || w > max_extent) {
    throw malformed(
        file, field,
        "has shape " + shape_text(field.shape) + ", the last two extents must be 2 to " + std::to_string(max_extent));
  }
  height = static_cast<int>(h);
  width = static_cast<int>(w);
}

/// A table of densities or areas.
std::vector<float> read_not_negative(const TensorFile& file, const TensorField& field) {
  std::vector<float> values = file.read_floats(field);
  const auto bad = std::find_if(values.begin(), values.end(), [](float v) { return v < 0; });
  if (bad != values.end()) {
    throw malformed(file, field,
                    "is " + std::to_string(*bad) + " at index " + std::to_string(bad - values.begin()) +
                        ", values must be at least 0");
  }
  return values;
}

void check_extent(const TensorFile& file, const TensorField& field, std::size_t axis, std::uint64_t expected,
                  const char* meaning) {
  if (field.shape[axis] == expected) return;
  throw malformed(file, field,
                  "has shape " + shape_text(field.shape) + ", extent " + std::to_string(axis) + " (" + meaning +
                      ") must be " + std::to_string(expected));
}

void check_slices(const TensorFile& file, const TensorField& field, std::uint64_t azimuths, std::uint64_t elevations) {
  check_extent(file, field, 0, azimuths, "azimuths of 'phi_i'");
  check_extent(file, field, 1, elevations, "elevations of 'theta_i'");
}

/// From [phi][theta][channel][y][x] to [theta][y][x][channel], first azimuth only.
std::vector<float> channel_last(const std::vector<float>& planes, std::size_t elevations, std::size_t pixels) {
  std::vector<float> values(elevations * pixels * rgb_channels);
  for (std::size_t t = 0; t < elevations; ++t) {
    for (std::size_t c = 0; c < rgb_channels; ++c) {
      const float* plane = planes.data() + (t * rgb_channels + c) * pixels;
      for (std::size_t p = 0; p < pixels; ++p) values[(t * pixels + p) * rgb_channels + c] = plane[p];
    }
  }
  return values;
}

std::string read_description(const TensorFile& file) {
  const TensorField* field = file.find("description");
  if (!field || field->type != TensorType::u8) return {};
  return printable_text({reinterpret_cast<const char*>(field->bytes.data()), field->bytes.size()});
}

bool read_jacobian(const TensorFile& file) {
  const TensorField* field = file.find("jacobian");
  if (!field) return true;
  if (field->type != TensorType::u8) {
    throw malformed(file, *field, std::string("has element type ") + to_string(field->type) + ", expected u8");
  }
  return field->bytes.empty() || field->bytes[0] != std::byte{0};
}

}  // namespace

RglMaterial read_rgl(std::span<const std::byte> bytes, const std::string& name, const IngestOptions& options) {
  const TensorFile file(bytes, name, options.limits);
  refuse_what_is_not_read_yet(file);
  refuse_anisotropic(file);
  check_memory(file, options.limits);

  RglMaterial material;
  VisibleNormalTable& t = material.table;
  t.theta_i = read_elevations(file);
  const std::uint64_t azimuths = file.find("phi_i")->count, elevations = t.theta_i.size();

  const TensorField& ndf = file.require("ndf", TensorType::f32, 2);
  read_resolution(file, ndf, t.ndf_height, t.ndf_width);
  const TensorField& sigma = file.require("sigma", TensorType::f32, 2);
  read_resolution(file, sigma, t.sigma_height, t.sigma_width);
  const TensorField& vndf = file.require("vndf", TensorType::f32, 4);
  check_slices(file, vndf, azimuths, elevations);
  read_resolution(file, vndf, t.vndf_height, t.vndf_width);
  const TensorField& rgb = file.require("rgb", TensorType::f32, 5);
  check_slices(file, rgb, azimuths, elevations);
  check_extent(file, rgb, 2, rgb_channels, "channels");
  read_resolution(file, rgb, t.height, t.width);

  t.ndf = read_not_negative(file, ndf);
  t.sigma = read_not_negative(file, sigma);
  t.vndf = read_not_negative(file, vndf);
  t.vndf.resize(t.vndf.size() / azimuths);
  t.values = channel_last(file.read_floats(rgb), t.theta_i.size(),
                          static_cast<std::size_t>(t.height) * static_cast<std::size_t>(t.width));
  t.jacobian = read_jacobian(file);
  material.description = read_description(file);
  return material;
}

}  // namespace brdf::ingest

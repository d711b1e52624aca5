// SPDX-License-Identifier: Apache-2.0
/// @file measurement.h
/// A measured BRDF as it was read: samples, coordinates, validity mask, units, channels, provenance.
#pragma once

#include <brdf/direction.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace brdf {

/// What a channel means. RGB is linear, with sRGB primaries unless the source says otherwise.
enum class ChannelModel : std::uint8_t { rgb = 0, xyz = 1, spectral = 2, scalar = 3 };

struct Channels {
  ChannelModel model = ChannelModel::rgb;
  int count = 3;
  std::vector<float> wavelengths_nm;  ///< `count` entries, ascending, when model is spectral; empty otherwise
};

/// Where in its bin a sample of a MERL table sits. Tools disagree; `edge` is what the published readers invert.
enum class SamplePosition : std::uint8_t { edge, centre };

/// Isotropic table in Rusinkiewicz (1998) half/difference angles, MERL layout (Matusik et al. 2003):
/// theta_h = ((i+o)/n_theta_h)^2 * 90 deg, theta_d = (j+o)/n_theta_d * 90 deg, phi_d = (k+o)/n_phi_d * (180|360) deg,
/// o = 0 (edge) or 1/2 (centre). Cell index = k + n_phi_d * (j + n_theta_d * i); channels of one cell are adjacent.
struct HalfDifferenceTable {
  int n_theta_h = 0, n_theta_d = 0, n_phi_d = 0;
  bool full_circle = false;  ///< phi_d covers 2 pi (360 bins); otherwise pi, and reciprocity gives the other half
  SamplePosition position = SamplePosition::edge;
  std::vector<float> values;        ///< f in 1/sr, without cosine; unspecified where not valid
  std::vector<std::uint8_t> valid;  ///< one per cell, 1 = every channel measured
};

/// Isotropic material of the RGL/EPFL database (Dupuy and Jakob 2018): f cos(theta_o) on a grid that follows the
/// microfacet visible normals. `wi` is the direction that the file tabulates. All tables are row-major float.
struct VisibleNormalTable {
  std::vector<float> theta_i;           ///< n nodes, radians, ascending
  int ndf_height = 0, ndf_width = 0;    ///< width runs along u = sqrt(2 theta / pi), height along phi
  std::vector<float> ndf;
  int sigma_height = 0, sigma_width = 0;
  std::vector<float> sigma;             ///< projected microsurface area
  int vndf_height = 0, vndf_width = 0;
  std::vector<float> vndf;              ///< [n][height][width]
  int height = 0, width = 0;
  std::vector<float> values;            ///< [n][height][width][channel]; may be negative (out of gamut, noise)
  bool jacobian = true;                 ///< multiply by ndf / (4 sigma)
};

struct Provenance {
  std::string name;         ///< material name: file name without folder, extension and channel suffix
  std::string format;       ///< "MERL" or "RGL"
  std::string description;  ///< free text from the file
  std::string licence;      ///< empty when the file does not say
  std::uint64_t content_hash = 0;  ///< XXH3-64 of the file's bytes
  std::uint64_t file_bytes = 0;
};

/// A measured BRDF. Plain data; values keep their sign, invalid cells stay masked and are never silently zero.
struct Measurement {
  Channels channels;
  Provenance provenance;
  std::variant<HalfDifferenceTable, VisibleNormalTable> table;
};

/// Interpolated value of a measurement, the reference of every error figure.
///
/// Trilinear over the valid corners of a MERL table (weights renormalised, linear in bin coordinates; no valid corner:
/// false), bilinear in the warped domain of an RGL table. Negative values are clipped to 0 after interpolation.
/// Evaluation is in double. Immutable and thread-safe; keeps a reference to the measurement, which must outlive it.
class MeasurementInterpolator {
 public:
  explicit MeasurementInterpolator(const Measurement& m);
  ~MeasurementInterpolator();
  MeasurementInterpolator(MeasurementInterpolator&&) noexcept;
  MeasurementInterpolator& operator=(MeasurementInterpolator&&) noexcept;

  /// f(wi, wo) in 1/sr without cosine into `f` (channels.count values). Returns whether a measured value exists;
  /// `f` is 0 where it does not and below the horizon.
  bool eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What a user should know about a file before trusting it.
struct IngestReport {
  std::uint64_t cells = 0;            ///< cells of the table
  std::uint64_t numbers = 0;          ///< cells times channels that the format really holds
  double invalid_fraction = 0;        ///< cells without a measurement
  double negative_fraction = 0;       ///< values below 0 among the valid ones
  double reciprocity_asymmetry = 0;   ///< mean |log(1+f(wi,wo)cos) - log(1+f(wo,wi)cos)|, directions uniform in solid angle below 85 deg
  double mirror_asymmetry = 0;        ///< the same for phi_d against -phi_d
  double max_albedo = 0;              ///< largest directional albedo over channels and theta, 0 to 85 degrees
  double max_value = 0;               ///< largest f in 1/sr
};

/// Deterministic; about 0.2 s.
IngestReport report(const Measurement& m);

}  // namespace brdf

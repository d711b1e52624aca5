// SPDX-License-Identifier: Apache-2.0
// The fixed directions at which every metric is measured. The encoder builds its own error model from the same set.
#pragma once

#include <brdf/direction.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace brdf::metrics {

/// Images of the sphere: an environment, then one directional light each.
inline constexpr std::array<std::string_view, 5> image_names{"env", "front", "deg45", "grazing", "top"};

/// Cosines of wo at which the directional albedo is compared.
inline constexpr std::array<double, 5> albedo_cosines{0.95, 0.8, 0.6, 0.4, 0.2};

/// Upper ends of the bands of max(theta_i, theta_o), degrees. The last band is reported apart.
inline constexpr std::array<double, 4> band_ends{60, 75, 85, 90};
inline constexpr std::uint8_t last_headline_band = 2;

/// Rows of one image. Only lit pixels have rows, so a directional light's image has one row a pixel.
struct ImageRows {
  std::size_t first = 0, rows = 0;
  std::uint32_t pixels = 0;
};

/// All rows: the images in the order of `image_names`, then the pairs, then the albedo quadrature.
struct QuerySet {
  std::vector<Vec3f> wi, wo;

  std::array<ImageRows, image_names.size()> image;
  std::vector<std::uint32_t> pixel;  ///< of every image row, within its image, not descending
  std::vector<std::uint16_t> light;  ///< of every row of the environment
  std::vector<Vec3d> radiance;       ///< RGB of a light of the environment, times its solid angle

  std::size_t first_pair = 0, pairs = 0;
  std::vector<double> pair_weight;      ///< a weighted mean is one over independent wi and wo, uniform in solid angle
  std::vector<std::uint8_t> pair_band;  ///< index into band_ends

  /// Rows of angle k are [albedo_begin[k], albedo_begin[k + 1]).
  std::array<std::size_t, albedo_cosines.size() + 1> albedo_begin{};
  std::vector<double> albedo_weight;  ///< of row albedo_begin[0] + i; albedo = sum of weight * f (cosine included)

  std::size_t rows() const noexcept { return wi.size(); }
  std::size_t image_rows() const noexcept { return first_pair; }

  /// What a unit of f in `channel` adds to its pixel at an image row: cos_i times the light. With other than three
  /// channels every channel sees the mean of the light's RGB.
  double gain(std::size_t row, int channel, int channels) const noexcept;
};

/// Builds the set; the same for every call. quality in (0, 1] scales the number of rows (1: about 1.1 million), shared
/// between more pixels and more lights for the images.
QuerySet build_queries(double quality);

/// Appends the pairs and their weights, and the albedo quadrature; parts of build_queries.
void append_pairs(QuerySet& set, double quality);
void append_albedo(QuerySet& set, double quality);

}  // namespace brdf::metrics

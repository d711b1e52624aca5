// SPDX-License-Identifier: Apache-2.0
#include "ingest/visible_normal_lookup.h"

#include <brdf/error.h>

#include "ingest/vertex_cell.h"
#include "ingest/weighted_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace brdf::ingest {
namespace {

/// Elevation of an axis of the tables: u = sqrt(2 theta / pi).
double u_of_theta(double theta) noexcept { return std::sqrt(theta * (2 / std::numbers::pi)); }

/// Azimuth of an axis of the tables: v = (phi + pi) / 2 pi for phi in [-pi, pi].
double v_of_phi(double phi) noexcept { return (phi + std::numbers::pi) / (2 * std::numbers::pi); }

/// phi_h - phi_i in [-pi, pi], in one step, so that it needs no unwrapping. A direction along the normal has azimuth 0.
double azimuth_between(const Vec3d& wi, double rho_i, const Vec3d& h, double rho_h) noexcept {
  if (!(rho_i > 0)) return std::atan2(h.y, h.x);
  if (!(rho_h > 0)) return -std::atan2(wi.y, wi.x);
  return std::atan2(wi.x * h.y - wi.y * h.x, wi.x * h.x + wi.y * h.y);
}

double interpolate(const std::vector<float>& table, int height, int width, SquarePoint p) noexcept {
  const auto h = static_cast<std::size_t>(height), w = static_cast<std::size_t>(width);
  const VertexCell x = vertex_cell(p.u * static_cast<double>(w - 1), w);
  const VertexCell y = vertex_cell(p.v * static_cast<double>(h - 1), h);
  const float* const lower = table.data() + y.left * w + x.left;
  const float* const upper = lower + w;
  return (1 - y.fraction) * ((1 - x.fraction) * double{lower[0]} + x.fraction * double{lower[1]}) +
         y.fraction * ((1 - x.fraction) * double{upper[0]} + x.fraction * double{upper[1]});
}

void check_size(const char* field, std::size_t found, std::size_t slices, int height, int width, std::size_t channels) {
  const std::size_t expected =
      height < 2 || width < 2 ? 0
                              : slices * static_cast<std::size_t>(height) * static_cast<std::size_t>(width) * channels;
  if (expected != 0 && found == expected) return;
  throw Error(ErrorCode::invalid_argument, std::string("visible-normal table: ") + field + " has " +
                                               std::to_string(found) + " values for " + std::to_string(height) + " x " +
                                               std::to_string(width) +
                                               " samples, at least 2 x 2 and a full set are needed");
}

/// The table, once its sizes are known to agree.
const VisibleNormalTable& checked(const VisibleNormalTable& t, int channels) {
  if (channels < 1) throw Error(ErrorCode::invalid_argument, "visible-normal table: needs at least 1 channel");
  if (std::adjacent_find(t.theta_i.begin(), t.theta_i.end(), std::greater_equal<>()) != t.theta_i.end()) {
    throw Error(ErrorCode::invalid_argument, "visible-normal table: theta_i does not ascend");
  }
  check_size("ndf", t.ndf.size(), 1, t.ndf_height, t.ndf_width, 1);
  check_size("sigma", t.sigma.size(), 1, t.sigma_height, t.sigma_width, 1);
  check_size("vndf", t.vndf.size(), t.theta_i.size(), t.vndf_height, t.vndf_width, 1);
  check_size("values", t.values.size(), t.theta_i.size(), t.height, t.width, static_cast<std::size_t>(channels));
  return t;
}

}  // namespace

bool rows_are_equal(const std::vector<float>& table, std::size_t width) {
  for (std::size_t k = width; k < table.size(); ++k) {
    if (table[k] != table[k - width]) return false;
  }
  return true;
}

VisibleNormalLookup::VisibleNormalLookup(const VisibleNormalTable& table, int channels)
    : table_(checked(table, channels)),
      channels_(static_cast<std::size_t>(channels)),
      visible_normals_(table.vndf, static_cast<std::size_t>(table.vndf_height),
                       static_cast<std::size_t>(table.vndf_width)),
      sigma_is_isotropic_(rows_are_equal(table.sigma, static_cast<std::size_t>(table.sigma_width))) {}

SliceBlend VisibleNormalLookup::elevation_blend(double theta_i) const noexcept {
  const std::vector<float>& nodes = table_.theta_i;
  const auto above = static_cast<std::size_t>(
      std::upper_bound(nodes.begin(), nodes.end(), theta_i, [](double t, float node) { return t < double{node}; }) -
      nodes.begin());
  if (above == 0) return {{{0, 1.0}, {0, 0.0}}};
  if (above == nodes.size()) return {{{above - 1, 1.0}, {above - 1, 0.0}}};
  const double lower = nodes[above - 1], upper = nodes[above];
  const double t = (theta_i - lower) / (upper - lower);
  return {{{above - 1, 1 - t}, {above, t}}};
}

double VisibleNormalLookup::jacobian(double u_i, const Vec3d& wi, SquarePoint half) const noexcept {
  constexpr double smallest_area = 1e-12;
  const double v_i = sigma_is_isotropic_ ? 0 : v_of_phi(std::atan2(wi.y, wi.x));
  const double sigma = interpolate(table_.sigma, table_.sigma_height, table_.sigma_width, {u_i, v_i});
  return interpolate(table_.ndf, table_.ndf_height, table_.ndf_width, half) / (4 * std::max(sigma, smallest_area));
}

void VisibleNormalLookup::stored(const SliceBlend& blend, SquarePoint half, std::span<double> values) const noexcept {
  const SquarePoint s = visible_normals_.to_uniform(half, blend);

  const auto height = static_cast<std::size_t>(table_.height), width = static_cast<std::size_t>(table_.width);
  const VertexCell x = vertex_cell(s.u * static_cast<double>(width - 1), width);
  const VertexCell y = vertex_cell(s.v * static_cast<double>(height - 1), height);
  std::array<WeightedCell, 8> corners;
  std::size_t count = 0;
  for (const auto& [slice, weight] : blend) {
    const float* const lower = table_.values.data() + ((slice * height + y.left) * width + x.left) * channels_;
    const float* const upper = lower + width * channels_;
    const double below = weight * (1 - y.fraction), above = weight * y.fraction;
    corners[count++] = {lower, below * (1 - x.fraction)};
    corners[count++] = {lower + channels_, below * x.fraction};
    corners[count++] = {upper, above * (1 - x.fraction)};
    corners[count++] = {upper + channels_, above * x.fraction};
  }
  weighted_sum(corners, values);
}

void VisibleNormalLookup::reflected(double theta_i, SquarePoint half, std::span<double> f_cos) const noexcept {
  stored(elevation_blend(theta_i), half, f_cos);
  if (!table_.jacobian) return;
  const double scale = jacobian(u_of_theta(theta_i), {std::sin(theta_i), 0, std::cos(theta_i)}, half);
  for (double& value : f_cos) value *= scale;
}

bool VisibleNormalLookup::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept {
  if (!(wi.z > 0) || !(wo.z > 0)) {
    std::fill(f.begin(), f.end(), 0.0);
    return false;
  }

  // the half vector, its length does not matter; above the horizon it cannot vanish
  const Vec3d h = wi + wo;
  const double rho_h = std::sqrt(h.x * h.x + h.y * h.y), rho_i = std::sqrt(wi.x * wi.x + wi.y * wi.y);
  const double theta_i = std::atan2(rho_i, wi.z);
  const SquarePoint half = {u_of_theta(std::atan2(rho_h, h.z)), v_of_phi(azimuth_between(wi, rho_i, h, rho_h))};

  stored(elevation_blend(theta_i), half, f);

  // the table holds f cos theta_o
  constexpr double smallest_cosine = 1e-9;
  double scale = 1 / std::max(wo.z, smallest_cosine);
  if (table_.jacobian) scale *= jacobian(u_of_theta(theta_i), wi, half);
  for (double& value : f) value = std::max(value, 0.0) * scale;
  return true;
}

}  // namespace brdf::ingest

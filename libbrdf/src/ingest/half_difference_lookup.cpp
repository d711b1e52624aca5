// SPDX-License-Identifier: Apache-2.0
#include "ingest/half_difference_lookup.h"

#include <brdf/error.h>

#include "ingest/half_difference_angles.h"
#include "ingest/half_difference_grid.h"
#include "ingest/vertex_cell.h"
#include "ingest/weighted_sum.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>

namespace brdf::ingest {
namespace {

/// The table, once its sizes are known to agree.
const HalfDifferenceTable& checked(const HalfDifferenceTable& t, int channels) {
  if (channels < 1 || t.n_theta_h < 2 || t.n_theta_d < 2 || t.n_phi_d < 2) {
    throw Error(ErrorCode::invalid_argument, "half/difference table: has " + std::to_string(t.n_theta_h) + " x " +
                                                 std::to_string(t.n_theta_d) + " x " + std::to_string(t.n_phi_d) +
                                                 " bins and " + std::to_string(channels) +
                                                 " channels, at least 2 x 2 x 2 and 1 are needed");
  }
  const std::size_t cells = HalfDifferenceGrid(t).cells();
  if (t.valid.size() != cells || t.values.size() != cells * static_cast<std::size_t>(channels)) {
    throw Error(ErrorCode::invalid_argument, "half/difference table: has " + std::to_string(t.values.size()) +
                                                 " values and " + std::to_string(t.valid.size()) +
                                                 " mask entries for " + std::to_string(cells) + " cells of " +
                                                 std::to_string(channels) + " channels");
  }
  return t;
}

/// Position x on a circle of n bins.
double wrapped(double x, double n) noexcept {
  if (x < 0) return x + n;
  return x >= n ? x - n : x;
}

}  // namespace

HalfDifferenceLookup::HalfDifferenceLookup(const HalfDifferenceTable& table, int channels)
    : table_(checked(table, channels)),
      channels_(static_cast<std::size_t>(channels)),
      offset_(table.position == SamplePosition::centre ? 0.5 : 0.0) {}

bool HalfDifferenceLookup::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> f) const noexcept {
  const auto no_value = [f]() noexcept {
    std::fill(f.begin(), f.end(), 0.0);
    return false;
  };
  if (!(wi.z > 0) || !(wo.z > 0)) return no_value();

  constexpr double quarter = std::numbers::pi / 2;
  const HalfDifferenceAngles angle = half_difference_angles(wi, wo, !table_.full_circle);
  const auto n_h = static_cast<std::size_t>(table_.n_theta_h), n_d = static_cast<std::size_t>(table_.n_theta_d),
             n_p = static_cast<std::size_t>(table_.n_phi_d);
  const VertexCell h = vertex_cell(static_cast<double>(n_h) * std::sqrt(angle.theta_h / quarter) - offset_, n_h);
  const VertexCell d = vertex_cell(static_cast<double>(n_d) * (angle.theta_d / quarter) - offset_, n_d);
  const double bins = static_cast<double>(n_p), circle = (table_.full_circle ? 4 : 2) * quarter;
  // n_p + 1 samples: the last one is the first again
  const VertexCell p = vertex_cell(wrapped(wrapped(bins * (angle.phi_d / circle), bins) - offset_, bins), n_p + 1);
  const std::size_t p_next = p.left + 1 < n_p ? p.left + 1 : 0;

  std::array<WeightedCell, 8> corners;
  std::size_t count = 0;
  double total = 0;
  const auto add = [&](std::size_t cell, double weight) noexcept {
    if (table_.valid[cell] == 0) return;
    corners[count++] = {table_.values.data() + cell * channels_, weight};
    total += weight;
  };
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t b = 0; b < 2; ++b) {
      const double weight = (a ? h.fraction : 1 - h.fraction) * (b ? d.fraction : 1 - d.fraction);
      const std::size_t row = ((h.left + a) * n_d + d.left + b) * n_p;
      add(row + p.left, weight * (1 - p.fraction));
      add(row + p_next, weight * p.fraction);
    }
  }
  constexpr double least_weight = 1e-9;  // less is rounding: the pair lies on an invalid corner
  if (!(total > least_weight)) return no_value();
  weighted_sum(std::span(corners).first(count), f);
  for (double& value : f) value = std::max(value, 0.0) / total;
  return true;
}

}  // namespace brdf::ingest

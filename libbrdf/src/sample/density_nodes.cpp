// SPDX-License-Identifier: Apache-2.0
#include "sample/density_nodes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::sample {
namespace {

using Table = ComponentTable;
using Map = HalfVectorMap<double>;

/// Share of a cosine-distributed density, where the table's nodes may have missed what f holds between them.
constexpr double cosine_share = 0.005;
/// Density that is left everywhere, also at the horizon: quotients of densities stay finite.
constexpr double least_density = 1e-6;
/// Views below 60 degrees or so, between which one looks more closely.
constexpr std::size_t grazing_views = 8;

/// cos theta_o of the view at a position among the nodes, which may lie between them and up to first_view below the first.
double view_cosine(double position) {
  const double wanted = (position + Table::first_view) / (static_cast<double>(Table::views) - 1 + Table::first_view);
  double below = 0, above = 1;
  for (int step = 0; step < 60; ++step) {
    const double c = 0.5 * (below + above);
    const double t = Table::horizon_share * std::sqrt(c) + (1 - Table::horizon_share) * (1 - std::sqrt(1 - c));
    (t < wanted ? below : above) = c;
  }
  return above;
}

Map map_at(double position) {
  const double c = view_cosine(position);
  return {std::sqrt(1 - c * c), c};
}

/// A height before the warp, and how much of it there is per t.
template <class T>
struct Height {
  T height, per_t;
};

Height<double> height_at(const HeightWarp& warp, double t) {
  const double height = warp.inverse(t);
  return {height, 1 / warp(height).slope};
}

/// A direction of the warped unit square and what it counts, on both sides.
template <class T>
struct Place {
  glm::vec<3, T> wi;
  T area;
};

template <class T>
Place<T> place(const HalfVectorMap<T>& map, Height<T> at, T v) {
  const typename HalfVectorMap<T>::Half h = map.half_vector(at.height, v);
  return {{2 * h.wo_h * h.x - map.s, 2 * h.wo_h * h.y, 2 * h.wo_h * h.z - map.c}, 2 * h.area * at.per_t};
}

/// The lower edge of a cell, or a place in it.
double in_row(std::size_t cell, double in_cell) { return (static_cast<double>(cell) + in_cell) / static_cast<double>(row_cells); }

/// The middle of one of `parts` equal parts of [0, 1].
double middle(std::size_t part, std::size_t parts) { return (static_cast<double>(part) + 0.5) / static_cast<double>(parts); }

/// f cos_i goes to 0 at the horizon, but for grazing views and rough lobes only when cos_i falls below cos_o. What lies in
/// the middle of the last cell, not that limit, continues the line that the cell begins.
void reach_horizon(double* last) { *last = std::max(2 * *last - last[-1], 0.0); }

}  // namespace

/// A point of the unit square between nodes.
struct DensityNodes::Probe {
  std::size_t node;  ///< of a view: the lower one in both directions
  double to_column, in_cell;
  float v;
  Height<float> height;
  double share;  ///< of the unit square
  bool at_horizon;
};

/// `parts` in each column, two in each cell of t and three more where the last one ends at the horizon.
std::vector<DensityNodes::Probe> DensityNodes::probes(std::size_t parts) const {
  struct InRow {
    std::size_t cell;
    double in_cell, share;
    Height<float> height;
  };
  std::vector<InRow> in_row_;
  const auto add = [&](std::size_t i, double in_cell, double share) {
    const Height<double> at = height_at(warp_, in_row(i, in_cell));
    in_row_.push_back({i, in_cell, share / static_cast<double>(row_cells), {static_cast<float>(at.height), static_cast<float>(at.per_t)}});
  };
  for (std::size_t i = 0; i < row_cells; ++i)
    for (const double in_cell : {0.25, 0.75}) add(i, in_cell, 0.5);
  for (const double in_cell : {0.9, 0.97, 0.99}) add(row_cells - 1, in_cell, 0);

  std::vector<Probe> all;
  const double rows = static_cast<double>(Table::columns * parts);
  for (std::size_t row = 0; row < Table::columns * parts; ++row) {
    const double v = (static_cast<double>(row) + 0.5) / rows;
    for (const InRow& p : in_row_)
      all.push_back({row / parts * edges + p.cell, middle(row % parts, parts), p.in_cell, static_cast<float>(v), p.height,
                     p.share / rows, p.cell + 1 == row_cells && p.in_cell > 0.5});
  }
  return all;
}

std::uint64_t DensityNodes::temporary_bytes(int channels) noexcept {
  constexpr std::uint64_t heights = 2 * row_cells + 3, wide = Table::columns * heights, close = 2 * wide, planes = 6;
  constexpr std::uint64_t per_probe = sizeof(Probe) + sizeof(Vec3d) + 2 * sizeof(double);
  const std::uint64_t evaluated = close * (planes + static_cast<std::uint64_t>(channels)) * sizeof(float);
  // lists grow by doubling
  return 2 * (wide + close) * sizeof(Probe) + close * per_probe + evaluated + 2 * Table::views * per_view * sizeof(double);
}

DensityNodes::DensityNodes(const HeightWarp& warp) : warp_(warp), density_(Table::views * per_view) {}

double DensityNodes::integral(std::span<const double> density) const noexcept {
  double sum = 0;
  for (std::size_t j = 0; j < Table::rows_per_view; ++j) {
    const double* const row = density.data() + j * edges;
    double total = 0;
    for (std::size_t i = 0; i < row_cells; ++i) total += 0.5 * (row[i] + row[i + 1]);
    sum += (j == 0 || j == Table::columns ? 0.5 : 1.0) * total;
  }
  return sum / static_cast<double>(Table::columns * row_cells);
}

void DensityNodes::normalise(std::size_t k) {
  const auto nodes = std::span(density_).subspan(k * per_view, per_view);
  const double whole = integral(nodes);
  for (double& density : nodes) density /= whole;
}

void DensityNodes::tabulate(Integrand& f) {
  std::vector<Vec3d> wi(per_view);
  std::vector<double> area(per_view), cosine(per_view), f_cos(per_view);
  std::array<Height<double>, edges> height;
  // the last stands in the middle of the last cell
  for (std::size_t i = 0; i < edges; ++i) height[i] = height_at(warp_, i < row_cells ? in_row(i, 0) : in_row(row_cells - 1, 0.5));
  for (std::size_t k = 0; k < Table::views; ++k) {
    const Map map = map_at(static_cast<double>(k));
    for (std::size_t n = 0; n < per_view; ++n) {
      const Place<double> p = place(map, height[n % edges], static_cast<double>(n / edges) / static_cast<double>(Table::columns));
      wi[n] = p.wi;
      area[n] = p.area;
      cosine[n] = std::max(p.wi.z, 0.0) * std::numbers::inv_pi * p.area;
    }
    f.evaluate(map, wi, f_cos);
    for (std::size_t n = 0; n < per_view; ++n) {
      f_cos[n] *= area[n];
      if (n % edges == row_cells) reach_horizon(&f_cos[n]), reach_horizon(&cosine[n]);
    }
    const double whole = integrals_[k] = integral(f_cos);
    const double scale = whole > 0 && std::isfinite(whole) ? (1 - cosine_share) / whole : 0;
    for (std::size_t n = 0; n < per_view; ++n)
      density_[k * per_view + n] = scale * f_cos[n] + (scale > 0 ? cosine_share : 1.0) * cosine[n] + least_density;
    normalise(k);
  }
}

void DensityNodes::assign(std::span<const double> density) {
  density_.assign(density.begin(), density.end());
  for (std::size_t k = 0; k < Table::views; ++k) normalise(k);
}

double DensityNodes::between(std::size_t k, const Probe& p) const noexcept {
  const double* const n = density_.data() + k * per_view + p.node;
  const double left = n[0] + p.in_cell * (n[1] - n[0]), right = n[edges] + p.in_cell * (n[edges + 1] - n[edges]);
  return left + p.to_column * (right - left);
}

void DensityNodes::cover(Integrand& f, double most) {
  std::vector<double> raised = density_;
  const std::vector<Probe> close = probes(2), wide = probes(1);
  for (std::size_t k = 0; k < Table::views; ++k) {
    // below the first view, then between two of them; the horizon takes lobes apart where views graze
    if (k == 0) {
      cover_view(f, most, close, 0, 0, -0.5 * static_cast<double>(Table::first_view), raised);
    } else if (k < grazing_views) {
      for (const double to_upper : {0.25, 0.75}) cover_view(f, most, close, k - 1, k, to_upper, raised);
    } else {
      cover_view(f, most, wide, k - 1, k, 0.5, raised);
    }
  }
  density_ = std::move(raised);
  for (std::size_t k = 0; k < Table::views; ++k) normalise(k);
}

void DensityNodes::cover_view(Integrand& f, double most, std::span<const Probe> probes, std::size_t lower, std::size_t upper,
                              double to_upper, std::vector<double>& raised) const {
  const Map map = map_at(static_cast<double>(lower) + to_upper);
  const HalfVectorMap<float> quick(static_cast<float>(map.s), static_cast<float>(map.c));
  std::vector<Vec3d> wi(probes.size());
  std::vector<double> f_cos(probes.size()), area(probes.size());
  for (std::size_t n = 0; n < probes.size(); ++n) {
    const Place<float> p = place(quick, probes[n].height, probes[n].v);
    wi[n] = Vec3d(p.wi);
    area[n] = static_cast<double>(p.area);
  }
  f.evaluate(map, wi, f_cos);
  double whole = 0;
  for (std::size_t n = 0; n < probes.size(); ++n) whole += (f_cos[n] *= area[n]) * probes[n].share;
  if (!(whole > 0) || !std::isfinite(whole)) return;
  const double up = std::max(to_upper, 0.0);
  for (std::size_t n = 0; n < probes.size(); ++n) {
    const double found = (1 - up) * between(lower, probes[n]) + up * between(upper, probes[n]), wanted = f_cos[n] / (whole * most);
    if (!(wanted > found) || !std::isfinite(wanted)) continue;
    for (const std::size_t k : {lower, upper}) raise(raised, k * per_view + probes[n].node, probes[n], wanted, found);
  }
}

void DensityNodes::raise(std::vector<double>& raised, std::size_t node, const Probe& at, double wanted, double found) const {
  for (const std::size_t n : {node, node + edges}) {
    if (at.at_horizon) {  // the horizon's own nodes are near 0, and no factor would do
      raised[n + 1] = std::max(raised[n + 1], density_[n + 1] + (wanted - found) / at.in_cell);
    } else {
      raised[n] = std::max(raised[n], density_[n] * (wanted / found));
      raised[n + 1] = std::max(raised[n + 1], density_[n + 1] * (wanted / found));
    }
  }
}

}  // namespace brdf::sample

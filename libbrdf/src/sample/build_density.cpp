// SPDX-License-Identifier: Apache-2.0
#include "sample/build_density.h"

#include "sample/density_nodes.h"
#include "sample/stored_density.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace brdf::sample {

namespace {

using Table = ComponentTable;

/// The choice between the components is never certain: each may be all that there is between the nodes of its share.
constexpr double least_share = 0.01;
/// What f may be between the nodes, in terms of the density there, before the nodes are raised.
constexpr double most_between_nodes = 2;

/// An integral that no search reaches.
constexpr float beyond = 1e30f;

void set_warp(double alpha, Table& t) {
  t.warp = HeightWarp(alpha);
  double lower = 0;
  for (std::size_t i = 0; i < row_cells; ++i) {
    const double upper = i + 1 < row_cells ? t.warp.inverse(static_cast<double>(i + 1) / row_cells) : 1.0;
    t.cell[i] = {static_cast<float>(lower), static_cast<float>(upper - lower), static_cast<float>(row_cells * (upper - lower) * t.warp(lower).slope)};
    lower = upper;
  }
}

/// Fills a row from densities at the edges; returns the integral.
double fill_row(std::span<const double> density, DensityRows& t, std::size_t at) {
  DensityRow& row = t.rows[at];
  QuarterRow& quarter = t.quarters[at];
  quarter.integral.fill(beyond);
  row.node.fill(beyond);
  double sum = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (i > 0) sum += 0.5 * (density[i - 1] + density[i]) / static_cast<double>(density.size() - 1);
    row.node[2 * i] = static_cast<float>(sum);
    row.node[2 * i + 1] = static_cast<float>(density[i]);
    if (i % 4 == 0 && i > 0 && i + 1 < density.size()) quarter.integral[i / 4 - 1] = static_cast<float>(sum);
  }
  return sum;
}

void fill_table(const DensityNodes& nodes, Table& t) {
  const auto resize = [](DensityRows& r, std::size_t rows) {
    r.rows.resize(rows);
    r.quarters.resize(rows);
  };
  resize(t.marginal, Table::views);
  resize(t.conditional, Table::views * Table::rows_per_view);
  for (std::size_t k = 0; k < Table::views; ++k) {
    std::array<double, Table::rows_per_view> totals;
    for (std::size_t j = 0; j < Table::rows_per_view; ++j)
      totals[j] = fill_row(nodes.view(k).subspan(j * DensityNodes::edges, DensityNodes::edges), t.conditional, k * Table::rows_per_view + j);
    fill_row(totals, t.marginal, k);
  }
}

/// Tables of all views; returns the integral of f for each.
std::array<double, Table::views> tabulate(Integrand f, Table& t) {
  DensityNodes nodes(t.warp);
  nodes.tabulate(f);
  nodes.cover(f, most_between_nodes);
  fill_table(nodes, t);
  return nodes.integrals();
}

double narrowest(const LobeSet& lobes, LobeKind kind) {
  double alpha = 1;
  for (const Lobe& lobe : lobes.lobes)
    if (lobe.kind == kind) alpha = std::min(alpha, lobe.alpha);
  return alpha;
}

}  // namespace

std::shared_ptr<const Material::Sampling> build_density(const LobeSet& lobes, const eval::Tables& tables, bool mirror_symmetric) {
  auto sampling = std::make_shared<Material::Sampling>();
  set_warp(narrowest(lobes, LobeKind::ggx), sampling->front);
  if (tables.lobes.forward_count == tables.lobes.ggx.size()) {
    tabulate(Integrand({{&tables, 1, false}}, mirror_symmetric), sampling->front);
    return sampling;
  }
  LobeSet retro{lobes.channels, {}};
  for (const Lobe& lobe : lobes.lobes)
    if (lobe.kind == LobeKind::retro_ggx) retro.lobes.push_back(lobe);
  eval::Tables retro_tables;
  retro_tables.lobes = eval::LobeParams(retro);
  const auto front_integrals = tabulate(Integrand({{&tables, 1, false}, {&retro_tables, -1, false}}, mirror_symmetric), sampling->front);
  Table& table = sampling->back.emplace();
  set_warp(narrowest(lobes, LobeKind::retro_ggx), table);
  const auto back_integrals = tabulate(Integrand({{&retro_tables, 1, true}}, true), table);
  for (std::size_t k = 0; k < Table::views; ++k) {
    const double sum = front_integrals[k] + back_integrals[k], share = sum > 0 ? back_integrals[k] / sum : 0.5;
    sampling->back_share[k] = static_cast<float>(std::clamp(std::isfinite(share) ? share : 0.5, least_share, 1 - least_share));
  }
  return sampling;
}

std::uint64_t build_density_temporary_bytes(int channels) noexcept { return DensityNodes::temporary_bytes(channels); }

NodeDensities node_densities(const Material::Sampling& tables) {
  NodeDensities nodes;
  const auto add = [&nodes](const Table& t) {
    std::vector<double>& density = nodes.components.emplace_back();
    for (const DensityRow& row : t.conditional.rows)
      for (std::size_t i = 0; i <= row_cells; ++i) density.push_back(static_cast<double>(row.node[2 * i + 1]));
  };
  add(tables.front);
  if (tables.back) add(*tables.back);
  for (std::size_t k = 0; k < Table::views; ++k) nodes.second[k] = static_cast<double>(tables.back_share[k]);
  return nodes;
}

std::shared_ptr<const Material::Sampling> density_from_nodes(const LobeSet& lobes, const NodeDensities& nodes) {
  auto sampling = std::make_shared<Material::Sampling>();
  const auto fill = [](double alpha, const std::vector<double>& density, Table& t) {
    set_warp(alpha, t);
    DensityNodes table(t.warp);
    table.assign(density);
    fill_table(table, t);
  };
  fill(narrowest(lobes, LobeKind::ggx), nodes.components[0], sampling->front);
  if (nodes.components.size() < 2) return sampling;
  fill(narrowest(lobes, LobeKind::retro_ggx), nodes.components[1], sampling->back.emplace());
  for (std::size_t k = 0; k < Table::views; ++k)
    sampling->back_share[k] = static_cast<float>(std::clamp(nodes.second[k], least_share, 1 - least_share));
  return sampling;
}

}  // namespace brdf::sample

namespace brdf {

std::size_t Material::Sampling::bytes() const noexcept {
  const auto table = [](const sample::ComponentTable& t) {
    return (t.marginal.rows.size() + t.conditional.rows.size()) * (sizeof(sample::DensityRow) + sizeof(sample::QuarterRow));
  };
  return sizeof(Sampling) + table(front) + (back ? table(*back) : 0);
}

}  // namespace brdf

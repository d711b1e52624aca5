// SPDX-License-Identifier: Apache-2.0
#include "sample/build_density.h"

#include "eval/batch_eval.h"
#include "sample/half_vector_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace brdf::sample {

namespace {

using Table = ComponentTable;
using Map = HalfVectorMap<double>;

/// Share of a cosine-distributed density, where the table's nodes may have missed what f holds between them.
constexpr double cosine_share = 0.005;
/// Density that is left everywhere, also at the horizon: quotients of densities stay finite.
constexpr double least_density = 1e-6;
/// The choice between the components is never certain: each may be all that there is between the nodes of its share.
constexpr double least_share = 0.01;

constexpr std::size_t edges = row_cells + 1, view_nodes = Table::rows_per_view * edges;
/// An integral that no search reaches.
constexpr float beyond = 1e30f;

double view_cosine(std::size_t k) {
  const double wanted = (static_cast<double>(k) + Table::first_view) / (static_cast<double>(Table::views) - 1 + Table::first_view);
  double below = 0, above = 1;
  for (int step = 0; step < 60; ++step) {
    const double c = 0.5 * (below + above);
    const double t = Table::horizon_share * std::sqrt(c) + (1 - Table::horizon_share) * (1 - std::sqrt(1 - c));
    (t < wanted ? below : above) = c;
  }
  return above;
}

/// Edges at equal steps of a function that rises like the integrals of GGX lobes at normal incidence, y (1 + k) / (y + k)
/// with k = alpha^2 / 2: the narrowest lobe, wider ones up to the whole range, because at grazing views the horizon takes
/// the lobe apart and measured lobes have long tails, and a line.
void place_edges(double alpha, Table& t) {
  const auto integral = [narrowest = 0.5 * alpha * alpha](double y) {
    const auto lobe = [y](double k) { return y * (1 + k) / (y + k); };
    double sum = 0, count = 0;
    for (double k = narrowest; k < 0.5; k *= 16, ++count) sum += lobe(k);
    return count > 0 ? 0.2 * lobe(narrowest) + 0.55 * sum / count + 0.25 * y : y;
  };
  for (std::size_t i = 1; i < row_cells; ++i) {
    const double wanted = static_cast<double>(i) / row_cells;
    double below = 0, above = 1;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (below + above);
      (integral(middle) < wanted ? below : above) = middle;
    }
    t.edge[i] = std::max(static_cast<float>(above), std::nextafter(t.edge[i - 1], 1.0f));
  }
  t.edge[row_cells] = t.edge[row_cells + 1] = 1;
}

/// Fills a row from densities at the edges; returns the integral.
double fill_row(std::span<const double> density, std::span<const double> width, DensityRow& row) {
  row.quarter.fill(beyond);
  row.node.fill(beyond);
  double sum = 0;
  for (std::size_t i = 0; i < density.size(); ++i) {
    if (i > 0) sum += 0.5 * (density[i - 1] + density[i]) * width[i - 1];
    row.node[2 * i] = static_cast<float>(sum);
    row.node[2 * i + 1] = static_cast<float>(density[i]);
    if (i % 4 == 0 && i > 0 && i + 1 < density.size()) row.quarter[i / 4 - 1] = static_cast<float>(sum);
  }
  return sum;
}

/// Mean over the channels of f cos_i for the directions of one view.
class Integrand {
 public:
  Integrand(const eval::Tables& tables, bool turned) : tables_(tables), turned_(turned ? -1.0f : 1.0f) {
    const auto channels = static_cast<std::size_t>(tables.lobes.channels);
    for (auto* plane : {&wi_x_, &wi_y_, &wi_z_, &wo_x_, &wo_y_, &wo_z_}) plane->resize(view_nodes);
    f_.resize(channels * view_nodes);
  }
  void set(std::size_t at, const Vec3d& wi) {
    wi_x_[at] = static_cast<float>(wi.x);
    wi_y_[at] = static_cast<float>(wi.y);
    wi_z_[at] = static_cast<float>(wi.z);
  }
  void add(const Map& map, double sign, std::span<double> f_cos) {
    std::fill(wo_x_.begin(), wo_x_.end(), turned_ * static_cast<float>(map.s));
    std::fill(wo_z_.begin(), wo_z_.end(), static_cast<float>(map.c));
    eval::eval_batch(tables_, {wi_x_.data(), wi_y_.data(), wi_z_.data(), view_nodes},
                     {wo_x_.data(), wo_y_.data(), wo_z_.data(), view_nodes}, {f_.data(), view_nodes});
    const auto channels = static_cast<std::size_t>(tables_.lobes.channels);
    for (std::size_t n = 0; n < view_nodes; ++n) {
      double sum = 0;
      for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(f_[c * view_nodes + n]);
      f_cos[n] += sign * sum / static_cast<double>(channels) * std::max(static_cast<double>(wi_z_[n]), 0.0);
    }
  }

 private:
  const eval::Tables& tables_;
  float turned_;
  std::vector<float> wi_x_, wi_y_, wi_z_, wo_x_, wo_y_, wo_z_, f_;
};

/// What the densities of a component follow: f, less the lobes that another component has.
struct Source {
  Integrand* f;
  Integrand* without;
};

/// f cos_i goes to 0 at the horizon, but for grazing views and rough lobes only when cos_i falls below cos_o. What lies in
/// the middle of the last cell, not that limit, continues the line that the cell begins.
void reach_horizon(double* last) { *last = std::max(2 * *last - last[-1], 0.0); }

/// Tables of all views; returns the integral of the source for each.
std::array<double, Table::views> tabulate(const Source& source, Table& t) {
  t.marginal.resize(Table::views);
  t.conditional.resize(Table::views * Table::rows_per_view);
  std::array<double, Table::views> integrals{};
  std::vector<double> f_cos(view_nodes), cosine(view_nodes), area(view_nodes);
  std::array<double, row_cells> width;
  for (std::size_t i = 0; i < row_cells; ++i) width[i] = static_cast<double>(t.edge[i + 1]) - static_cast<double>(t.edge[i]);
  std::array<double, Table::columns> column_width;
  column_width.fill(1.0 / static_cast<double>(Table::columns));
  for (std::size_t k = 0; k < Table::views; ++k) {
    const double c = view_cosine(k);
    const Map map(std::sqrt(1 - c * c), c);
    for (std::size_t n = 0; n < view_nodes; ++n) {
      const double v = static_cast<double>(n / edges) / static_cast<double>(Table::columns);
      // the last one in the middle of the last cell
      const bool last = n % edges == row_cells;
      const double height = static_cast<double>(t.edge[n % edges]) - (last ? 0.5 * width[row_cells - 1] : 0.0);
      const Map::Half h = map.half_vector(height, v);
      const Vec3d wi{2 * h.wo_h * h.x - map.s, 2 * h.wo_h * h.y, 2 * h.wo_h * h.z - map.c};
      source.f->set(n, wi);
      if (source.without) source.without->set(n, wi);
      area[n] = 2 * h.area;  // of both sides
      cosine[n] = std::max(wi.z, 0.0) * std::numbers::inv_pi * area[n];
    }
    std::fill(f_cos.begin(), f_cos.end(), 0.0);
    source.f->add(map, 1, f_cos);
    if (source.without) source.without->add(map, -1, f_cos);
    for (std::size_t n = 0; n < view_nodes; ++n) {
      f_cos[n] = f_cos[n] > 0 && std::isfinite(f_cos[n]) ? f_cos[n] * area[n] : 0.0;
      if (n % edges == row_cells) reach_horizon(&f_cos[n]), reach_horizon(&cosine[n]);
    }

    DensityRow* const rows = &t.conditional[k * Table::rows_per_view];
    std::array<double, Table::rows_per_view> totals;
    const auto integrate = [&](std::span<const double> density) {
      for (std::size_t j = 0; j < Table::rows_per_view; ++j)
        totals[j] = fill_row(density.subspan(j * edges, edges), width, rows[j]);
      return fill_row(totals, column_width, t.marginal[k]);
    };
    const double whole = integrals[k] = integrate(f_cos);
    const double scale = whole > 0 && std::isfinite(whole) ? (1 - cosine_share) / whole : 0;
    for (std::size_t n = 0; n < view_nodes; ++n)
      f_cos[n] = scale * f_cos[n] + (scale > 0 ? cosine_share : 1.0) * cosine[n] + least_density;
    const double norm = integrate(f_cos);
    for (double& density : f_cos) density /= norm;
    integrate(f_cos);
  }
  return integrals;
}

double narrowest(const LobeSet& lobes, LobeKind kind) {
  double alpha = 1;
  for (const Lobe& lobe : lobes.lobes)
    if (lobe.kind == kind) alpha = std::min(alpha, lobe.alpha);
  return alpha;
}

}  // namespace

std::shared_ptr<const Material::Sampling> build_density(const LobeSet& lobes, const eval::Tables& tables) {
  auto sampling = std::make_shared<Material::Sampling>();
  Integrand f(tables, false);
  place_edges(narrowest(lobes, LobeKind::ggx), sampling->front);
  if (tables.lobes.forward_count == tables.lobes.ggx.size()) {
    tabulate({&f, nullptr}, sampling->front);
    return sampling;
  }
  LobeSet retro{lobes.channels, {}};
  for (const Lobe& lobe : lobes.lobes)
    if (lobe.kind == LobeKind::retro_ggx) retro.lobes.push_back(lobe);
  eval::Tables retro_tables;
  retro_tables.lobes = eval::LobeParams(retro);
  Integrand ahead(retro_tables, false), back(retro_tables, true);
  const auto front_integrals = tabulate({&f, &ahead}, sampling->front);
  Table& table = sampling->back.emplace();
  place_edges(narrowest(lobes, LobeKind::retro_ggx), table);
  const auto back_integrals = tabulate({&back, nullptr}, table);
  for (std::size_t k = 0; k < Table::views; ++k) {
    const double sum = front_integrals[k] + back_integrals[k], share = sum > 0 ? back_integrals[k] / sum : 0.5;
    sampling->back_share[k] = static_cast<float>(std::clamp(std::isfinite(share) ? share : 0.5, least_share, 1 - least_share));
  }
  return sampling;
}

}  // namespace brdf::sample

namespace brdf {

std::size_t Material::Sampling::bytes() const noexcept {
  const auto table = [](const sample::ComponentTable& t) {
    return (t.marginal.size() + t.conditional.size()) * sizeof(sample::DensityRow);
  };
  return sizeof(Sampling) + table(front) + (back ? table(*back) : 0);
}

}  // namespace brdf

// SPDX-License-Identifier: Apache-2.0
#include "density_cells.h"

#include "direction_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace brdf::cli {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int roots_theta = 16, roots_phi = 32, deepest = 18;
constexpr std::size_t most_cells = 60000;

// Gauss-Legendre nodes and weights of order 4 on [0, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 4> node{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, 4> node_weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                            0.1739274225687269};
constexpr std::size_t nodes = node.size() * node.size();

struct Angles {
  double theta, phi;
};

struct Cell {
  double theta, phi, d_theta, d_phi;
  double mass = 0;   ///< integral of pdf
  double f_cos = 0;  ///< integral of the mean of the channels of f cos theta_i
  std::vector<Angles> samples;
};

/// Sets the integrals of every cell, in one batch.
void integrate(const Material& material, const Vec3f& wo, std::span<Cell> cells) {
  DirectionPlanes wi(cells.size() * nodes), view(cells.size() * nodes);
  std::vector<double> weight(cells.size() * nodes);
  std::size_t k = 0;
  for (const Cell& cell : cells) {
    for (std::size_t a = 0; a < node.size(); ++a) {
      for (std::size_t b = 0; b < node.size(); ++b, ++k) {
        const double theta = cell.theta + node[a] * cell.d_theta, phi = cell.phi + node[b] * cell.d_phi;
        const double sine = std::sin(theta);
        wi.set(k, Vec3f(Vec3d(sine * std::cos(phi), sine * std::sin(phi), std::cos(theta))));
        view.set(k, wo);
        weight[k] = node_weight[a] * node_weight[b] * sine * cell.d_theta * cell.d_phi;
      }
    }
  }
  const auto channels = static_cast<std::size_t>(material.channels());
  std::vector<float> pdf(weight.size()), f(weight.size() * channels);
  material.eval_pdf(wi.span(), view.span(), {f.data(), weight.size()}, pdf.data());
  k = 0;
  for (Cell& cell : cells) {
    cell.mass = cell.f_cos = 0;
    for (std::size_t n = 0; n < nodes; ++n, ++k) {
      cell.mass += weight[k] * static_cast<double>(pdf[k]);
      double sum = 0;
      for (std::size_t c = k; c < f.size(); c += weight.size()) sum += static_cast<double>(f[c]);
      cell.f_cos += weight[k] * sum / static_cast<double>(channels) * static_cast<double>(wi.get(k).z);
    }
  }
}

std::vector<Cell> root_cells(std::span<const Vec3f> samples) {
  std::vector<Cell> cells;
  constexpr double d_theta = pi / 2 / roots_theta, d_phi = 2 * pi / roots_phi;
  for (int i = 0; i < roots_theta; ++i)
    for (int j = 0; j < roots_phi; ++j) cells.push_back({i * d_theta, j * d_phi - pi, d_theta, d_phi, 0, 0, {}});
  for (const Vec3f& w : samples) {
    const Vec3d d(w);
    const Angles a{std::atan2(std::hypot(d.x, d.y), d.z), std::atan2(d.y, d.x)};
    const int i = std::clamp(static_cast<int>(a.theta / d_theta), 0, roots_theta - 1);
    const int j = std::clamp(static_cast<int>((a.phi + pi) / d_phi), 0, roots_phi - 1);
    cells[static_cast<std::size_t>(i * roots_phi + j)].samples.push_back(a);
  }
  return cells;
}

/// Four parts, in the order of theta and then phi.
std::array<Cell, 4> split(const Cell& cell) {
  const double d_theta = cell.d_theta / 2, d_phi = cell.d_phi / 2;
  const double theta = cell.theta + d_theta, phi = cell.phi + d_phi;
  std::array<Cell, 4> parts{{{cell.theta, cell.phi, d_theta, d_phi, 0, 0, {}},
                             {cell.theta, phi, d_theta, d_phi, 0, 0, {}},
                             {theta, cell.phi, d_theta, d_phi, 0, 0, {}},
                             {theta, phi, d_theta, d_phi, 0, 0, {}}}};
  for (const Angles& a : cell.samples) {
    parts[(a.theta >= theta ? 2U : 0U) + (a.phi >= phi ? 1U : 0U)].samples.push_back(a);
  }
  return parts;
}

}  // namespace

DensityCells::DensityCells(const Material& material, const Vec3f& wo, std::span<const Vec3f> samples) {
  const double n = static_cast<double>(std::max<std::size_t>(samples.size(), 1));
  std::vector<Cell> open = root_cells(samples);
  integrate(material, wo, open);
  for (int depth = 0; !open.empty(); ++depth) {
    std::vector<Cell> parts;
    for (const Cell& cell : open)
      for (Cell& part : split(cell)) parts.push_back(std::move(part));
    integrate(material, wo, parts);
    std::vector<Cell> next;
    const bool may_split = depth < deepest && mass_.size() + parts.size() < most_cells;
    for (std::size_t i = 0; i < open.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += parts[4 * i + k].mass;
      // Well below the noise of counting n samples.
      const double tolerance = 0.02 * std::sqrt(std::max(open[i].mass, sum) / n) + 1e-7;
      const bool crowded = static_cast<double>(open[i].samples.size()) > n / 256 && depth < deepest / 2;
      const bool split_again = may_split && (std::abs(sum - open[i].mass) > tolerance || crowded);
      for (std::size_t k = 0; k < 4; ++k) {
        Cell& part = parts[4 * i + k];
        if (split_again) {
          next.push_back(std::move(part));
        } else {
          mass_.push_back(part.mass);
          count_.push_back(static_cast<double>(part.samples.size()));
          integral_ += part.mass;
          f_cos_ += part.f_cos;
        }
      }
    }
    open = std::move(next);
  }
}

}  // namespace brdf::cli

// SPDX-License-Identifier: Apache-2.0
#include "eval/grid_params.h"

#include "residual/grid_coordinates.h"
#include "residual/half_float.h"

#include <brdf/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace brdf::eval {

namespace {

constexpr std::size_t padding_halves = 8;
constexpr std::uint64_t max_nodes = std::uint64_t{1} << 24;  // exact in float

void require(bool ok, ErrorCode code, const char* field, const std::string& found, const std::string& allowed) {
  if (ok) return;
  throw Error(code, "Residual grid: " + std::string(field) + " is " + found + ", allowed is " + allowed + ".");
}

/// u = t (share (1 + kappa) / (t + kappa) + 1 - share), times n - 1
GridParams::Axis warped_axis(int n, float kappa) {
  const double scale = n - 1, k = kappa, share = residual::warp_share;
  return {kappa, static_cast<float>(scale * (share * (1 + k) + (1 - share) * k)), static_cast<float>(scale * (1 - share))};
}

}  // namespace

GridParams::GridParams(const residual::ResidualGrid& grid, int channels) {
  if (grid.empty()) return;
  constexpr auto bad = ErrorCode::invalid_argument;
  require(grid.channels == channels, bad, "the number of channels", std::to_string(grid.channels), std::to_string(channels));
  for (int n : {grid.n_h, grid.n_d, grid.n_p})
    require(n >= 1 && n <= 1 << 16, bad, "a number of nodes", std::to_string(n), "1 to 65536");
  for (float k : {grid.kappa_h, grid.kappa_d})
    require(k > 0 && std::isfinite(k), bad, "kappa", std::to_string(k), "positive and finite");
  require(grid.epsilon >= 0 && grid.epsilon <= 1e30f, bad, "epsilon", std::to_string(grid.epsilon), "0 to 1e30");
  const std::uint64_t rows = static_cast<std::uint64_t>(grid.n_h) * static_cast<std::uint64_t>(grid.n_d);
  const std::uint64_t nodes = rows * static_cast<std::uint64_t>(grid.n_p);
  require(nodes <= max_nodes, ErrorCode::limit_exceeded, "the number of nodes", std::to_string(nodes), "at most 16777216");
  const std::uint64_t halves = nodes * static_cast<std::uint64_t>(channels);
  require(grid.ratio.size() >= halves + padding_halves, bad, "the number of halves", std::to_string(grid.ratio.size()),
          "at least " + std::to_string(halves + padding_halves));
  // unsigned, so that halves below the range come out on top; four at a time, as this would else be a fifth of a decode
  const auto beyond = [&grid](std::uint64_t k) { return static_cast<std::uint16_t>(grid.ratio[k] - residual::half_min_normal); };
  std::array<std::uint16_t, 4> largest{};
  std::uint64_t k = 0;
  for (; k + 4 <= halves; k += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) largest[lane] = std::max(largest[lane], beyond(k + lane));
  for (; k < halves; ++k) largest[0] = std::max(largest[0], beyond(k));
  require(*std::max_element(largest.begin(), largest.end()) <= residual::half_max - residual::half_min_normal, bad, "a ratio",
          "not a positive normal half", "2^-14 to 65504");

  ratio = grid.ratio.data();
  const auto last = [](int n) { return static_cast<float>(std::max(n - 2, 0)); };
  scale_p = static_cast<float>(grid.n_p - 1);
  last_h = last(grid.n_h);
  last_d = last(grid.n_d);
  last_p = last(grid.n_p);
  nodes_d = static_cast<float>(grid.n_d);
  nodes_p = static_cast<float>(grid.n_p);
  node_halves = channels;
  step_p = grid.n_p > 1 ? node_halves : 0;
  step_d = grid.n_d > 1 ? node_halves * grid.n_p : 0;
  step_h = grid.n_h > 1 ? node_halves * grid.n_p * grid.n_d : 0;
  axis_h = warped_axis(grid.n_h, grid.kappa_h);
  axis_d = warped_axis(grid.n_d, grid.kappa_d);
  epsilon = grid.epsilon;
  azimuth = grid.azimuth;

  lanes.kappa = {axis_h.kappa, axis_d.kappa, 1, 1};
  lanes.last = {last_h, last_d, last_p, 0};
  // symmetric: u_p = q for either side; else q / 2 on the upper one and 1 - q / 2 on the lower one.
  // With kappa 1, t (a + a t) / (t + 1) = a t
  const bool folded = azimuth == residual::Azimuth::symmetric;
  const float rising = folded ? scale_p : 0.5f * scale_p, falling = folded ? scale_p : -0.5f * scale_p;
  lanes.side[1] = {{axis_h.linear, axis_d.linear, rising, 0}, {axis_h.square, axis_d.square, rising, 0}, {}};
  lanes.side[0] = {{axis_h.linear, axis_d.linear, falling, 0},
                   {axis_h.square, axis_d.square, falling, 0},
                   {0, 0, folded ? 0.0f : scale_p, 0}};
  lanes.halves = {3 * grid.n_d * grid.n_p, 3 * grid.n_p, 3, 0};
}

}  // namespace brdf::eval

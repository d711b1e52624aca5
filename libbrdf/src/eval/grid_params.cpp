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
  const auto end = grid.ratio.begin() + static_cast<std::ptrdiff_t>(halves);
  const auto wrong = std::find_if_not(grid.ratio.begin(), end, residual::is_positive_normal_half);
  require(wrong == end, bad, "a ratio", "not a positive normal half", "2^-14 to 65504");

  ratio = grid.ratio.data();
  const auto last = [](int n) { return static_cast<float>(std::max(n - 2, 0)); };
  scale_h = static_cast<float>(grid.n_h - 1);
  scale_d = static_cast<float>(grid.n_d - 1);
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
  kappa_h = grid.kappa_h;
  kappa_d = grid.kappa_d;
  warp_a_h = static_cast<float>(residual::warp_share * (1 + static_cast<double>(kappa_h)));
  warp_a_d = static_cast<float>(residual::warp_share * (1 + static_cast<double>(kappa_d)));
  epsilon = grid.epsilon;
  reciprocal = grid.reciprocal;
}

}  // namespace brdf::eval

// SPDX-License-Identifier: Apache-2.0
// What the lobes miss, as quantised coefficients: the plain type between fit and container.
#pragma once

#include "residual/azimuth.h"
#include "residual/slice_frame.h"

#include <cstdint>
#include <vector>

namespace brdf::residual {

/// Quantised parameters of the basis, as they are stored. Values outside the ranges are malformed.
struct BasisCodes {
  std::uint8_t kappa_h = 15;   ///< 0..31
  std::uint8_t kappa_d = 10;   ///< 0..15
  std::uint8_t window_h = 6;   ///< 0..15
  std::uint8_t window_d = 6;   ///< 0..15
  std::uint8_t epsilon = 118;  ///< 0..largest_epsilon_code
  std::uint8_t shape = 0;      ///< index into order_shapes
  std::uint8_t table = 0;      ///< index into balanced_grids: how the nodes of the balanced table are shared out
};

inline constexpr int largest_epsilon_code = 227;  ///< 2^99

double kappa_h_of(int code) noexcept;   ///< 0.003 * 2^(code/3): theta_h axis, see grid_coordinates.h
double kappa_d_of(int code) noexcept;   ///< 0.125 * 2^(code/2)
double window_of(int code) noexcept;    ///< 0.02 * 2^(code/2.5): pole windows
double epsilon_of(int code) noexcept;   ///< 2^(code - 128), 1/sr
double step_of(int code) noexcept;      ///< 2^(4 - code/8): quantiser step of a layer

int kappa_h_code(double v) noexcept;    ///< nearest codes, clamped
int kappa_d_code(double v) noexcept;
int window_code(double v) noexcept;
int epsilon_code(double v) noexcept;
int step_code(double v) noexcept;

/// One refinement. Channel c adds q * step to its coefficients [begin[c], end[c]) of the order. A layer goes on where the
/// one before ended, or, when `restart`, begins again at 0 with a finer step.
struct Layer {
  std::uint8_t step = 64;
  bool restart = false;
  std::vector<std::uint32_t> end;            ///< one per (transformed) channel
  std::vector<std::vector<std::int32_t>> q;  ///< q[c] has end[c] - begin[c] entries
};

struct ResidualCode {
  BasisCodes basis;
  SliceFrame slices;        ///< empty: coefficients are in half/difference coordinates
  Azimuth azimuth = Azimuth::one_way;
  int channels = 3;
  std::vector<Layer> layers;
  bool empty() const noexcept { return layers.empty(); }
};

/// Begin of `layer` in channel c, given the layer before it (or none).
inline std::uint32_t layer_begin(const Layer* before, const Layer& layer, std::size_t c) noexcept {
  return before == nullptr || layer.restart ? 0 : before->end[c];
}

/// Largest number of coefficients of one channel that the format allows.
inline constexpr std::uint32_t max_coefficients = 16384;
inline constexpr std::int32_t max_magnitude = 1 << 20;

}  // namespace brdf::residual

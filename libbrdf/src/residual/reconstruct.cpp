// SPDX-License-Identifier: Apache-2.0
#include "residual/reconstruct.h"

#include "residual/basis.h"
#include "residual/node_sums.h"
#include "residual/order_extent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::residual {
namespace {

int phi_nodes(const GridSize& size, Azimuth azimuth) noexcept { return azimuth == Azimuth::symmetric ? (size.n_p + 1) / 2 : size.n_p; }

/// Tables of one axis: cosine[j][node] and window^m as [m][node], rows padded for vectors.
struct AxisTables {
  std::size_t stride;
  std::vector<float> cosine, window;
};

AxisTables axis_tables(int n, int frequencies, int harmonics, Azimuth azimuth, double kappa, double width) {
  AxisTables t{padded(static_cast<std::size_t>(n)), {}, {}};
  t.cosine.assign(t.stride * static_cast<std::size_t>(frequencies), 0.0F);
  t.window.assign(t.stride * static_cast<std::size_t>(harmonics), 0.0F);
  std::vector<float> row(static_cast<std::size_t>(frequencies));
  for (int i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / (n - 1);
    cosines(std::cos(std::numbers::pi * u), frequencies, row.data());
    for (std::size_t j = 0; j < row.size(); ++j) t.cosine[j * t.stride + static_cast<std::size_t>(i)] = row[j];
    const double chord_t = unwarp(u, kappa);               // sqrt(1 - cos theta)
    const double cosine = 1 - chord_t * chord_t;
    const double w = pole_window(std::sqrt(std::max(0.0, 1 - cosine * cosine)), width);
    double power = 1;
    for (int m = 0; m < harmonics; ++m, power *= w)
      t.window[static_cast<std::size_t>(m) * t.stride + static_cast<std::size_t>(i)] =
          static_cast<float>(harmonic(m, azimuth).order == m ? power : power * w);
  }
  return t;
}

}  // namespace

Coefficients dequantise(const ResidualCode& code, ChannelTransform transform, std::size_t layers) {
  Coefficients c;
  c.basis = code.basis;
  c.slices = code.slices;
  c.azimuth = code.azimuth;
  c.channels = code.channels;
  c.transform = transform;
  layers = std::min(layers, code.layers.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < layers; ++i)
    for (const std::uint32_t e : code.layers[i].end) count = std::max(count, e);
  c.order = coefficient_order(order_shapes[code.basis.shape], even_only(code.azimuth), count, reach_of(code.slices));
  c.values.assign(static_cast<std::size_t>(code.channels), std::vector<float>(c.order.size(), 0.0F));
  for (std::size_t i = 0; i < layers; ++i) {
    const Layer& layer = code.layers[i];
    const double step = step_of(layer.step);
    for (std::size_t ch = 0; ch < layer.q.size(); ++ch) {
      const std::uint32_t begin = layer_begin(i == 0 ? nullptr : &code.layers[i - 1], layer, ch);
      for (std::size_t j = 0; j < layer.q[ch].size(); ++j)
        c.values[ch][begin + j] += static_cast<float>(layer.q[ch][j] * step);
    }
  }
  return c;
}

std::size_t grid_bytes(const GridSize& size, Azimuth azimuth, int channels) noexcept {
  const auto nodes = static_cast<std::size_t>(size.n_h) * static_cast<std::size_t>(size.n_d) *
                     static_cast<std::size_t>(phi_nodes(size, azimuth));
  return (nodes * static_cast<std::size_t>(channels) + 8) * sizeof(std::uint16_t);
}

std::size_t reconstruct_temporary_bytes(const Coefficients& c, const GridSize& size) noexcept {
  const Extent reach = extent(c.order);
  const auto k = static_cast<std::size_t>(std::max(reach.k, 1)), l = static_cast<std::size_t>(std::max(reach.l, 1)),
             m = static_cast<std::size_t>(std::max(reach.m, 1)), channels = static_cast<std::size_t>(c.channels);
  const std::size_t h = padded(static_cast<std::size_t>(size.n_h)), d = padded(static_cast<std::size_t>(size.n_d)),
                    p = padded(static_cast<std::size_t>(phi_nodes(size, c.azimuth)));
  const std::size_t axes = h * (k + m) + d * (l + m) + p * m + k + l + m, sums = m * l * h + m * d + m * l;
  return (axes + sums + c.order.size()) * sizeof(float) + static_cast<std::size_t>(size.n_h) * static_cast<std::size_t>(size.n_d) * p * sizeof(std::uint16_t) +
         channels * channels * sizeof(double);
}

ResidualGrid reconstruct(const Coefficients& c, const GridSize& size) {
  const Basis basis = basis_of(c.basis);
  const int np = phi_nodes(size, c.azimuth);
  const auto nh = static_cast<std::size_t>(size.n_h), nd = static_cast<std::size_t>(size.n_d), n_phi = static_cast<std::size_t>(np);
  const Extent reach = extent(c.order);
  const auto channels = static_cast<std::size_t>(c.channels);

  ResidualGrid grid;
  grid.n_h = size.n_h;
  grid.n_d = size.n_d;
  grid.n_p = np;
  grid.channels = c.channels;
  grid.azimuth = c.azimuth;
  grid.kappa_h = static_cast<float>(basis.kappa_h);
  grid.kappa_d = static_cast<float>(basis.kappa_d);
  grid.epsilon = static_cast<float>(basis.epsilon);
  grid.ratio.assign(nh * nd * n_phi * channels + 8, std::uint16_t{0});

  const AxisTables h = axis_tables(size.n_h, std::max(reach.k, 1), std::max(reach.m, 1), c.azimuth, basis.kappa_h, basis.window_h);
  const AxisTables d = axis_tables(size.n_d, std::max(reach.l, 1), std::max(reach.m, 1), c.azimuth, basis.kappa_d, basis.window_d);
  const auto harmonics = static_cast<std::size_t>(std::max(reach.m, 1)), nl = static_cast<std::size_t>(std::max(reach.l, 1));
  const std::size_t phi_stride = padded(n_phi);
  std::vector<float> phi(harmonics * phi_stride);  // cos(m phi) at the nodes
  for (std::size_t p = 0; p < n_phi; ++p) {
    const double v = static_cast<double>(p) / (np - 1) * (c.azimuth == Azimuth::symmetric ? 0.5 : 1.0);
    std::vector<float> row(harmonics);
    residual::harmonics(cos_phi_of(v), c.azimuth, static_cast<int>(harmonics), row.data());
    for (std::size_t m = 0; m < harmonics; ++m) phi[m * phi_stride + p] = row[m];
  }

  const std::vector<double> matrix = channel_matrix(c.transform, c.channels);
  std::vector<float> value(c.order.size());                   // of one channel after the inverse channel transform
  std::vector<std::uint16_t> plane(nh * nd * phi_stride);     // one channel: [h][d][p]
  for (std::size_t ch = 0; ch < channels; ++ch) {
    std::fill(value.begin(), value.end(), 0.0F);
    for (std::size_t t = 0; t < channels; ++t) {
      const auto weight = static_cast<float>(matrix[t * channels + ch]);
      if (weight == 0.0F) continue;
      for (std::size_t j = 0; j < value.size(); ++j) value[j] += weight * c.values[t][j];
    }
    sum_nodes({c.order, value, nh, nd, nl, harmonics, h.stride, d.stride, phi_stride, h.cosine.data(), d.cosine.data(),
               phi.data(), h.window.data(), d.window.data()},
              plane.data());
    for (std::size_t i = 0; i < nh * nd; ++i)
      for (std::size_t p = 0; p < n_phi; ++p) grid.ratio[(i * n_phi + p) * channels + ch] = plane[i * phi_stride + p];
  }
  return grid;
}

}  // namespace brdf::residual

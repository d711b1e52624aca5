// SPDX-License-Identifier: Apache-2.0
#include "residual/reconstruct.h"

#include "residual/basis.h"
#include "residual/half_float.h"
#include "residual/order_extent.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace brdf::residual {
namespace {

/// Half floats stay normal: ratios between 2^-14 and 2^15.
constexpr float log_ratio_min = -9.7F, log_ratio_max = 10.39F;

int phi_nodes(const GridSize& size, bool reciprocal) noexcept { return reciprocal ? (size.n_p + 1) / 2 : size.n_p; }

/// exp for |x| < 80, relative error below 3e-7, in plain arithmetic so that compilers vectorise it.
inline float exp_fast(float x) noexcept {
  const float t = x * 1.44269504F;
  const float whole = static_cast<float>(static_cast<int>(t + (t >= 0 ? 0.5F : -0.5F)));
  const float r = (x - whole * 0.693359375F) + whole * 2.12194440e-4F;
  float p = 1.9875691500e-4F;
  p = p * r + 1.3981999507e-3F;
  p = p * r + 8.3334519073e-3F;
  p = p * r + 4.1665795894e-2F;
  p = p * r + 1.6666665459e-1F;
  p = p * r + 5.0000001201e-1F;
  const float e = p * r * r + r + 1.0F;
  return e * std::bit_cast<float>((static_cast<int>(whole) + 127) << 23);
}

/// Tables of one axis: cosine[j * n + node] and window^m, m-major.
struct AxisTables {
  int n;
  std::vector<float> cosine, window;
};

AxisTables axis_tables(int n, int frequencies, int harmonics, double kappa, double width) {
  AxisTables t{n, std::vector<float>(static_cast<std::size_t>(n) * static_cast<std::size_t>(frequencies)),
               std::vector<float>(static_cast<std::size_t>(n) * static_cast<std::size_t>(harmonics))};
  std::vector<float> row(static_cast<std::size_t>(frequencies));
  for (int i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / (n - 1);
    cosines(std::cos(std::numbers::pi * u), frequencies, row.data());
    for (std::size_t j = 0; j < row.size(); ++j) t.cosine[j * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)] = row[j];
    const double chord_t = unwarp(u, kappa);               // sqrt(1 - cos theta)
    const double cosine = 1 - chord_t * chord_t;
    const double w = pole_window(std::sqrt(std::max(0.0, 1 - cosine * cosine)), width);
    double power = 1;
    for (int m = 0; m < harmonics; ++m, power *= w)
      t.window[static_cast<std::size_t>(m) * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)] = static_cast<float>(power);
  }
  return t;
}

}  // namespace

Coefficients dequantise(const ResidualCode& code, ChannelTransform transform, std::size_t layers) {
  Coefficients c;
  c.basis = code.basis;
  c.slices = code.slices;
  c.reciprocal = code.reciprocal;
  c.channels = code.channels;
  c.transform = transform;
  layers = std::min(layers, code.layers.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < layers; ++i)
    for (const std::uint32_t e : code.layers[i].end) count = std::max(count, e);
  c.order = coefficient_order(order_shapes[code.basis.shape], code.reciprocal, count, reach_of(code.slices));
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

std::size_t grid_bytes(const GridSize& size, bool reciprocal, int channels) noexcept {
  const auto nodes = static_cast<std::size_t>(size.n_h) * static_cast<std::size_t>(size.n_d) *
                     static_cast<std::size_t>(phi_nodes(size, reciprocal));
  return (nodes * static_cast<std::size_t>(channels) + 8) * sizeof(std::uint16_t);
}

ResidualGrid reconstruct(const Coefficients& c, const GridSize& size) {
  const Basis basis = basis_of(c.basis);
  const int np = phi_nodes(size, c.reciprocal);
  const auto nh = static_cast<std::size_t>(size.n_h), nd = static_cast<std::size_t>(size.n_d), n_phi = static_cast<std::size_t>(np);
  const Extent reach = extent(c.order);
  const auto channels = static_cast<std::size_t>(c.channels);

  ResidualGrid grid;
  grid.n_h = size.n_h;
  grid.n_d = size.n_d;
  grid.n_p = np;
  grid.channels = c.channels;
  grid.reciprocal = c.reciprocal;
  grid.kappa_h = static_cast<float>(basis.kappa_h);
  grid.kappa_d = static_cast<float>(basis.kappa_d);
  grid.epsilon = static_cast<float>(basis.epsilon);
  grid.ratio.assign(nh * nd * n_phi * channels + 8, std::uint16_t{0});

  const AxisTables h = axis_tables(size.n_h, std::max(reach.k, 1), std::max(reach.m, 1), basis.kappa_h, basis.window_h);
  const AxisTables d = axis_tables(size.n_d, std::max(reach.l, 1), std::max(reach.m, 1), basis.kappa_d, basis.window_d);
  const auto harmonics = static_cast<std::size_t>(std::max(reach.m, 1)), nl = static_cast<std::size_t>(std::max(reach.l, 1));
  std::vector<float> phi(harmonics * n_phi);  // cos(m phi) at the nodes
  for (std::size_t p = 0; p < n_phi; ++p) {
    const double v = static_cast<double>(p) / (np - 1) * (c.reciprocal ? 0.5 : 1.0);
    std::vector<float> row(harmonics);
    cosines(cos_phi_of(v), static_cast<int>(harmonics), row.data());
    for (std::size_t m = 0; m < harmonics; ++m) phi[m * n_phi + p] = row[m];
  }

  const std::vector<double> matrix = channel_matrix(c.transform, c.channels);
  std::vector<float> value(c.order.size());            // of one channel after the inverse channel transform
  std::vector<float> along_h(nl * harmonics * nh);     // [m][l][h]
  std::vector<char> used(nl * harmonics);
  std::vector<float> over_hd(harmonics * nh * nd);     // [m][h][d]
  std::vector<float> line(n_phi);
  for (std::size_t ch = 0; ch < channels; ++ch) {
    std::fill(value.begin(), value.end(), 0.0F);
    for (std::size_t t = 0; t < channels; ++t) {
      const auto weight = static_cast<float>(matrix[t * channels + ch]);
      if (weight == 0.0F) continue;
      for (std::size_t j = 0; j < value.size(); ++j) value[j] += weight * c.values[t][j];
    }
    std::fill(along_h.begin(), along_h.end(), 0.0F);
    std::fill(used.begin(), used.end(), char{0});
    for (std::size_t j = 0; j < value.size(); ++j) {
      if (value[j] == 0.0F) continue;
      const std::size_t lm = c.order[j].m * nl + c.order[j].l;
      used[lm] = 1;
      const float* cosine = h.cosine.data() + c.order[j].k * nh;
      float* out = along_h.data() + lm * nh;
      for (std::size_t i = 0; i < nh; ++i) out[i] += value[j] * cosine[i];
    }
    std::fill(over_hd.begin(), over_hd.end(), 0.0F);
    for (std::size_t m = 0; m < harmonics; ++m)
      for (std::size_t l = 0; l < nl; ++l) {
        if (used[m * nl + l] == 0) continue;
        const float* in = along_h.data() + (m * nl + l) * nh;
        const float* cosine = d.cosine.data() + l * nd;
        for (std::size_t i = 0; i < nh; ++i) {
          float* out = over_hd.data() + (m * nh + i) * nd;
          for (std::size_t j = 0; j < nd; ++j) out[j] += in[i] * cosine[j];
        }
      }
    for (std::size_t m = 0; m < harmonics; ++m)
      for (std::size_t i = 0; i < nh; ++i)
        for (std::size_t j = 0; j < nd; ++j) over_hd[(m * nh + i) * nd + j] *= h.window[m * nh + i] * d.window[m * nd + j];
    for (std::size_t i = 0; i < nh; ++i)
      for (std::size_t j = 0; j < nd; ++j) {
        std::fill(line.begin(), line.end(), 0.0F);
        for (std::size_t m = 0; m < harmonics; ++m) {
          const float a = over_hd[(m * nh + i) * nd + j];
          if (a == 0.0F) continue;
          const float* cosine = phi.data() + m * n_phi;
          for (std::size_t p = 0; p < n_phi; ++p) line[p] += a * cosine[p];
        }
        for (std::size_t p = 0; p < n_phi; ++p) line[p] = exp_fast(std::clamp(line[p], log_ratio_min, log_ratio_max));
        std::uint16_t* out = grid.ratio.data() + ((i * nd + j) * n_phi) * channels + ch;
        for (std::size_t p = 0; p < n_phi; ++p) out[p * channels] = half_from_float(line[p]);
      }
  }
  return grid;
}

}  // namespace brdf::residual

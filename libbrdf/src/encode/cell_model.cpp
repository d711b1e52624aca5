// SPDX-License-Identifier: Apache-2.0
#include "encode/error_model.h"
#include "residual/order_extent.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace brdf::encode {
namespace {

using residual::Extent;
using residual::Frequency;

/// table[j * n + i] = cos(pi j u_i)
std::vector<double> cosine_table(const std::vector<double>& u, int count) {
  std::vector<double> t(u.size() * static_cast<std::size_t>(count));
  std::vector<double> row(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < u.size(); ++i) {
    residual::cosines(std::cos(std::numbers::pi * u[i]), count, row.data());
    for (std::size_t j = 0; j < row.size(); ++j) t[j * u.size() + i] = row[j];
  }
  return t;
}

std::vector<double> phi_table(const std::vector<double>& cos_phi, int count) {
  std::vector<double> t(cos_phi.size() * static_cast<std::size_t>(count));
  std::vector<double> row(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < cos_phi.size(); ++i) {
    residual::cosines(cos_phi[i], count, row.data());
    for (std::size_t j = 0; j < row.size(); ++j) t[j * cos_phi.size() + i] = row[j];
  }
  return t;
}

std::vector<double> powers(const std::vector<double>& sine, double width, int power) {
  std::vector<double> w;
  for (const double s : sine) w.push_back(std::pow(residual::pole_window(s, width), power));
  return w;
}

/// sum over cells of field * window^power * cos(q phi) cos(pi k u_h) cos(pi l u_d) for all k, l of the tables.
class CosineTransform {
 public:
  CosineTransform(const Bins& b, const residual::Basis& basis, int k, int l, int q)
      : b_(b), basis_(basis), k_(static_cast<std::size_t>(k)), l_(static_cast<std::size_t>(l)),
        h_(cosine_table(b.u_h, k)), d_(cosine_table(b.u_d, l)), phi_(phi_table(b.cos_phi, q)) {}

  /// Sums over phi first: out[h][d].
  std::vector<double> along_phi(std::span<const double> field, int q) const {
    const auto np = static_cast<std::size_t>(b_.n_p);
    std::vector<double> out(field.size() / np);
    const double* c = phi_.data() + static_cast<std::size_t>(q) * np;
    for (std::size_t i = 0; i < out.size(); ++i) {
      double s = 0;
      for (std::size_t p = 0; p < np; ++p) s += field[i * np + p] * c[p];
      out[i] = s;
    }
    return out;
  }

  /// out[k][l] from a field over (h, d).
  std::vector<double> over_hd(const std::vector<double>& field, int power) const {
    const auto nh = static_cast<std::size_t>(b_.n_h), nd = static_cast<std::size_t>(b_.n_d);
    const std::vector<double> wh = powers(b_.sin_h, basis_.window_h, power), wd = powers(b_.sin_d, basis_.window_d, power);
    std::vector<double> half(nh * l_, 0.0), out(k_ * l_, 0.0);
    for (std::size_t i = 0; i < nh; ++i)
      for (std::size_t l = 0; l < l_; ++l) {
        double s = 0;
        for (std::size_t j = 0; j < nd; ++j) s += field[i * nd + j] * wd[j] * d_[l * nd + j];
        half[i * l_ + l] = s * wh[i];
      }
    for (std::size_t k = 0; k < k_; ++k)
      for (std::size_t i = 0; i < nh; ++i)
        for (std::size_t l = 0; l < l_; ++l) out[k * l_ + l] += h_[k * nh + i] * half[i * l_ + l];
    return out;
  }

 private:
  const Bins& b_;
  const residual::Basis& basis_;
  std::size_t k_, l_;
  std::vector<double> h_, d_, phi_;
};

}  // namespace

ErrorModel cell_model(const Bins& b, std::span<const double> weights, const residual::Basis& basis,
                      std::span<const Frequency> order, residual::ChannelTransform transform) {
  const Extent reach = residual::extent(order);
  const int k2 = 2 * reach.k, l2 = 2 * reach.l, q2 = 2 * reach.m;
  const CosineTransform cosine(b, basis, k2, l2, q2);
  ErrorModel model;
  model.size = order.size();

  // transforms[power][q]: only q <= power of the same parity occur, power = m + m'
  std::vector<std::vector<double>> by_phi;
  for (int q = 0; q < q2; ++q) by_phi.push_back(cosine.along_phi(weights, q));
  const auto slot = [&](int power, int q) { return static_cast<std::size_t>(power * q2 + q); };
  std::vector<std::vector<double>> transforms(static_cast<std::size_t>(q2 * q2));
  std::vector<char> has_m(static_cast<std::size_t>(reach.m), 0);
  for (const Frequency& f : order) has_m[f.m] = 1;
  const auto need = [&](int power, int q) {
    auto& t = transforms[slot(power, q)];
    if (t.empty()) t = cosine.over_hd(by_phi[static_cast<std::size_t>(q)], power);
  };
  for (int m = 0; m < reach.m; ++m)
    for (int n = 0; n <= m; ++n)
      if (has_m[static_cast<std::size_t>(m)] != 0 && has_m[static_cast<std::size_t>(n)] != 0) {
        need(m + n, m + n);
        need(m + n, m - n);
      }

  model.gram.resize(model.size * model.size);
  const auto l_stride = static_cast<std::size_t>(l2);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Frequency a = order[i];
    for (std::size_t j = 0; j <= i; ++j) {
      const Frequency c = order[j];
      const std::vector<double>& sum = transforms[slot(a.m + c.m, a.m + c.m)];
      const std::vector<double>& difference = transforms[slot(a.m + c.m, std::abs(a.m - c.m))];
      const std::size_t k_plus = static_cast<std::size_t>(a.k + c.k) * l_stride;
      const std::size_t k_minus = static_cast<std::size_t>(std::abs(a.k - c.k)) * l_stride;
      const auto l_plus = static_cast<std::size_t>(a.l + c.l), l_minus = static_cast<std::size_t>(std::abs(a.l - c.l));
      const double g = sum[k_plus + l_plus] + sum[k_plus + l_minus] + sum[k_minus + l_plus] + sum[k_minus + l_minus] +
                       difference[k_plus + l_plus] + difference[k_plus + l_minus] + difference[k_minus + l_plus] +
                       difference[k_minus + l_minus];
      model.gram[i * model.size + j] = model.gram[j * model.size + i] = g / 8;
    }
  }

  const auto channels = static_cast<std::size_t>(b.channels);
  const std::vector<double> matrix = residual::channel_matrix(transform, b.channels);
  std::vector<double> field(b.cells());
  for (std::size_t t = 0; t < channels; ++t) {
    for (std::size_t cell = 0; cell < field.size(); ++cell) {
      double y = 0;
      for (std::size_t c = 0; c < channels; ++c) y += matrix[t * channels + c] * b.y[cell * channels + c];
      field[cell] = weights[cell] * y;
      model.constant += weights[cell] * y * y;
    }
    std::vector<double> right(model.size, 0.0);
    for (int m = 0; m < reach.m; ++m) {
      if (has_m[static_cast<std::size_t>(m)] == 0) continue;
      const std::vector<double> projected = cosine.over_hd(cosine.along_phi(field, m), m);
      for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i].m == m) right[i] = projected[order[i].k * l_stride + order[i].l];
    }
    model.b.push_back(std::move(right));
  }
  return model;
}

double model_error(const ErrorModel& model, const std::vector<std::vector<double>>& a) {
  double e = model.constant;
  for (std::size_t c = 0; c < a.size(); ++c)
    for (std::size_t i = 0; i < model.size; ++i) {
      if (a[c][i] == 0) continue;
      double g = 0;
      for (std::size_t j = 0; j < model.size; ++j) g += model.gram[i * model.size + j] * a[c][j];
      e += a[c][i] * (g - 2 * model.b[c][i]);
    }
  return e;
}

}  // namespace brdf::encode

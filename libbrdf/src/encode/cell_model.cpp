// SPDX-License-Identifier: Apache-2.0
#include "encode/error_model.h"
#include "residual/order_extent.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace brdf::encode {
namespace {

using residual::Extent;
using residual::Frequency;
using residual::Harmonic;

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

/// cos(q phi), then sin(q phi), as [2 q + sine][p]; phi in [0, pi]
std::vector<double> phi_table(const std::vector<double>& cos_phi, int count) {
  std::vector<double> t(cos_phi.size() * 2 * static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < cos_phi.size(); ++i) {
    const double phi = std::acos(cos_phi[i]);
    std::vector<double> row(static_cast<std::size_t>(count));
    residual::cosines(cos_phi[i], count, row.data());
    for (std::size_t q = 0; q < row.size(); ++q) {
      t[2 * q * cos_phi.size() + i] = row[q];
      t[(2 * q + 1) * cos_phi.size() + i] = std::sin(static_cast<double>(q) * phi);
    }
  }
  return t;
}

std::vector<double> powers(const std::vector<double>& sine, double width, int power) {
  std::vector<double> w;
  for (const double s : sine) w.push_back(std::pow(residual::pole_window(s, width), power));
  return w;
}

/// sum over cells of field * window^power * (cos or sin)(q phi) cos(pi k u_h) cos(pi l u_d) for all k, l of the tables.
class CosineTransform {
 public:
  CosineTransform(const Bins& b, const residual::Basis& basis, int k, int l, int q)
      : b_(b), basis_(basis), k_(static_cast<std::size_t>(k)), l_(static_cast<std::size_t>(l)),
        h_(cosine_table(b.u_h, k)), d_(cosine_table(b.u_d, l)), phi_(phi_table(b.cos_phi, q)) {}

  /// Sums over phi first: out[h][d].
  std::vector<double> along_phi(std::span<const double> field, Harmonic f) const {
    const auto np = static_cast<std::size_t>(b_.n_p);
    std::vector<double> out(field.size() / np);
    const double* c = phi_.data() + (2 * static_cast<std::size_t>(f.order) + (f.sine ? 1 : 0)) * np;
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

namespace {

/// (cos or sin)(a phi) (cos or sin)(c phi) = (first + sign second) / 2, the sign of the orders included.
struct Product {
  Harmonic first, second;
  double sign_first, sign_second;
};

Product product(Harmonic a, Harmonic c) noexcept {
  const int sum = a.order + c.order, difference = a.order - c.order;
  const Harmonic of_difference{std::abs(difference), a.sine != c.sine};
  if (a.sine == c.sine) return {of_difference, {sum, false}, 1.0, a.sine ? -1.0 : 1.0};
  const double sign = (a.sine ? difference : -difference) < 0 ? -1.0 : 1.0;  // the sine is odd
  return {of_difference, {sum, true}, sign, 1.0};
}

}  // namespace

ErrorModel cell_model(const Bins& b, std::span<const double> weights, const residual::Basis& basis, residual::Azimuth azimuth,
                      std::span<const Frequency> order, residual::ChannelTransform transform) {
  const Extent reach = residual::extent(order);
  const int k2 = 2 * reach.k, l2 = 2 * reach.l, q2 = 2 * reach.m + 1;
  const CosineTransform cosine(b, basis, k2, l2, q2);
  ErrorModel model;
  model.size = order.size();
  const auto of = [azimuth](int m) { return residual::harmonic(m, azimuth); };

  // transforms of the weights by power of the window and harmonic, as far as products of basis functions need them
  const auto slot = [&](int power, Harmonic f) { return static_cast<std::size_t>((power * q2 + f.order) * 2 + (f.sine ? 1 : 0)); };
  std::vector<std::vector<double>> transforms(static_cast<std::size_t>(q2 * q2 * 2)), by_phi(static_cast<std::size_t>(q2 * 2));
  std::vector<char> has_m(static_cast<std::size_t>(reach.m), 0);
  for (const Frequency& f : order) has_m[f.m] = 1;
  const auto need = [&](int power, Harmonic f) {
    auto& t = transforms[slot(power, f)];
    if (!t.empty()) return;
    auto& along = by_phi[slot(0, f)];
    if (along.empty()) along = cosine.along_phi(weights, f);
    t = cosine.over_hd(along, power);
  };
  for (int m = 0; m < reach.m; ++m)
    for (int n = 0; n <= m; ++n)
      if (has_m[static_cast<std::size_t>(m)] != 0 && has_m[static_cast<std::size_t>(n)] != 0) {
        const Product p = product(of(m), of(n));
        need(of(m).order + of(n).order, p.first);
        need(of(m).order + of(n).order, p.second);
      }

  model.gram.resize(model.size * model.size);
  const auto l_stride = static_cast<std::size_t>(l2);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Frequency a = order[i];
    for (std::size_t j = 0; j <= i; ++j) {
      const Frequency c = order[j];
      const Product p = product(of(std::max(a.m, c.m)), of(std::min(a.m, c.m)));
      const int power = of(a.m).order + of(c.m).order;
      const std::vector<double>& first = transforms[slot(power, p.first)];
      const std::vector<double>& second = transforms[slot(power, p.second)];
      const std::size_t k_plus = static_cast<std::size_t>(a.k + c.k) * l_stride;
      const std::size_t k_minus = static_cast<std::size_t>(std::abs(a.k - c.k)) * l_stride;
      const auto l_plus = static_cast<std::size_t>(a.l + c.l), l_minus = static_cast<std::size_t>(std::abs(a.l - c.l));
      double g = 0;
      const auto add = [&](const std::vector<double>& t, double sign) {
        for (const std::size_t at : {k_plus + l_plus, k_plus + l_minus, k_minus + l_plus, k_minus + l_minus}) g += sign * t[at];
      };
      add(second, p.sign_second);
      add(first, p.sign_first);
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
      const std::vector<double> projected = cosine.over_hd(cosine.along_phi(field, of(m)), of(m).order);
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

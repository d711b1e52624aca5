// SPDX-License-Identifier: Apache-2.0
#include "encode/bins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

constexpr double lowest_cosine = 0.02;  // 88.9 degrees: beyond it measurements are extrapolations

struct Axis {
  std::vector<double> u, sine, cosine, width;
};

double theta_of(double u, double kappa) noexcept {
  return 2 * std::asin(std::min(1.0, residual::unwarp(u, kappa) / std::numbers::sqrt2));
}

Axis axis(int n, double kappa) {
  Axis a;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) / n, theta = theta_of(u, kappa);
    a.u.push_back(u);
    a.sine.push_back(std::sin(theta));
    a.cosine.push_back(std::cos(theta));
    a.width.push_back(theta_of(static_cast<double>(i + 1) / n, kappa) - theta_of(static_cast<double>(i) / n, kappa));
  }
  return a;
}

/// Running sums of a cell.
class Averages {
 public:
  Averages(Bins& bins) : bins_(bins), count_(bins.cells(), 0) {}

  void add(std::size_t cell, const double* f, const double* y) noexcept {
    ++count_[cell];
    const auto n = static_cast<std::size_t>(bins_.channels);
    for (std::size_t c = 0; c < n; ++c) {
      bins_.f[cell * n + c] += f[c];
      bins_.y[cell * n + c] += y[c];
    }
  }
  bool empty(std::size_t cell) const noexcept { return count_[cell] == 0; }
  void finish() noexcept {
    const auto n = static_cast<std::size_t>(bins_.channels);
    for (std::size_t cell = 0; cell < count_.size(); ++cell) {
      // cells of a table may lie above the horizon in a bin whose middle, which gives the weights, does not
      if (count_[cell] == 0 || std::min(bins_.cos_i[cell], bins_.cos_o[cell]) < lowest_cosine) continue;
      bins_.valid[cell] = 1;
      for (std::size_t c = 0; c < n; ++c) {
        bins_.f[cell * n + c] /= count_[cell];
        bins_.y[cell * n + c] /= count_[cell];
      }
    }
  }

 private:
  Bins& bins_;
  std::vector<std::uint32_t> count_;
};

class LogRatio {
 public:
  LogRatio(const LobeSet& lobes, double epsilon)
      : lobes_(lobes), epsilon_(epsilon), l_(static_cast<std::size_t>(lobes.channels)) {}
  void operator()(const Vec3d& wi, const Vec3d& wo, const double* f, double* y) {
    eval_lobes(lobes_, wi, wo, l_);
    for (std::size_t c = 0; c < l_.size(); ++c) y[c] = std::log((std::max(f[c], 0.0) + epsilon_) / (l_[c] + epsilon_));
  }

 private:
  const LobeSet& lobes_;
  double epsilon_;
  std::vector<double> l_;
};

void add_table_cells(const HalfDifferenceTable& t, Bins& bins, const residual::Basis& basis, LogRatio& ratio, Averages& out) {
  const auto n = static_cast<std::size_t>(bins.channels);
  const double offset = t.position == SamplePosition::centre ? 0.5 : 0.0;
  const double pi = std::numbers::pi;
  std::vector<double> f(n), y(n);
  const auto place = [](double theta, double kappa, int count) {
    const double u = residual::warp(residual::chord(std::sin(theta), std::cos(theta)), kappa);
    return std::min(static_cast<int>(u * count), count - 1);
  };
  std::size_t cell = 0;
  for (int i = 0; i < t.n_theta_h; ++i) {
    const double s = (i + offset) / t.n_theta_h, theta_h = s * s * pi / 2;
    const int bin_h = place(theta_h, basis.kappa_h, bins.n_h);
    for (int j = 0; j < t.n_theta_d; ++j) {
      const double theta_d = (j + offset) / t.n_theta_d * pi / 2;
      const int bin_d = place(theta_d, basis.kappa_d, bins.n_d);
      for (int k = 0; k < t.n_phi_d; ++k, ++cell) {
        if (t.valid[cell] == 0) continue;
        const double phi = (k + offset) / t.n_phi_d * (t.full_circle ? 2 * pi : pi);
        Vec3d wi, wo;
        geometry::directions_from_half_difference(theta_h, theta_d, phi, wi, wo);
        if (std::min(wi.z, wo.z) < lowest_cosine) continue;
        for (std::size_t c = 0; c < n; ++c) f[c] = static_cast<double>(t.values[cell * n + c]);
        ratio(wi, wo, f.data(), y.data());
        const double folded = std::acos(std::clamp(std::cos(phi), -1.0, 1.0));  // mirror symmetry: |phi_d|
        const auto base = static_cast<std::size_t>(bins.n_p) *
                          static_cast<std::size_t>(bin_d + bins.n_d * bin_h);
        const auto bin_p = std::min(static_cast<std::size_t>(folded / pi * bins.n_p), static_cast<std::size_t>(bins.n_p - 1));
        out.add(base + bin_p, f.data(), y.data());
        if (!t.full_circle) out.add(base + static_cast<std::size_t>(bins.n_p) - 1 - bin_p, f.data(), y.data());
      }
    }
  }
}

}  // namespace

Bins sample_bins(const Measurement& m, const LobeSet& lobes, const residual::Basis& basis, int n_h, int n_d, int n_p) {
  Bins b;
  b.n_h = n_h;
  b.n_d = n_d;
  b.n_p = n_p;
  b.channels = m.channels.count;
  const Axis h = axis(n_h, basis.kappa_h), d = axis(n_d, basis.kappa_d);
  b.u_h = h.u;
  b.sin_h = h.sine;
  b.cos_h = h.cosine;
  b.d_theta_h = h.width;
  b.u_d = d.u;
  b.sin_d = d.sine;
  b.cos_d = d.cosine;
  b.d_theta_d = d.width;
  for (int p = 0; p < n_p; ++p) b.cos_phi.push_back(std::cos((p + 0.5) / n_p * std::numbers::pi));
  const auto n = static_cast<std::size_t>(b.channels);
  const std::size_t cells = static_cast<std::size_t>(n_h) * static_cast<std::size_t>(n_d) * static_cast<std::size_t>(n_p);
  b.cos_i.resize(cells);
  b.cos_o.resize(cells);
  b.valid.assign(cells, 0);
  b.f.assign(cells * n, 0.0);
  b.y.assign(cells * n, 0.0);

  LogRatio ratio(lobes, basis.epsilon);
  Averages averages(b);
  // the middles first give every cell its geometry; tables with cells of their own are then averaged
  std::size_t cell = 0;
  for (std::size_t i = 0; i < h.u.size(); ++i)
    for (std::size_t j = 0; j < d.u.size(); ++j)
      for (std::size_t k = 0; k < b.cos_phi.size(); ++k, ++cell) {
        const double base = h.cosine[i] * d.cosine[j], tilt = h.sine[i] * d.sine[j] * b.cos_phi[k];
        b.cos_i[cell] = base - tilt;
        b.cos_o[cell] = base + tilt;
      }
  if (const auto* table = std::get_if<HalfDifferenceTable>(&m.table)) add_table_cells(*table, b, basis, ratio, averages);
  const MeasurementInterpolator reference(m);
  std::vector<double> f(n), y(n);
  for (cell = 0; cell < cells; ++cell) {
    if (!averages.empty(cell) || std::min(b.cos_i[cell], b.cos_o[cell]) < lowest_cosine) continue;
    const std::size_t k = cell % b.cos_phi.size(), j = cell / b.cos_phi.size() % d.u.size(), i = cell / b.cos_phi.size() / d.u.size();
    Vec3d wi, wo;
    const double sin_phi = std::sqrt(std::max(0.0, 1 - b.cos_phi[k] * b.cos_phi[k]));
    const double x = d.sine[j] * b.cos_phi[k], yy = d.sine[j] * sin_phi, z = d.cosine[j];
    wi = {h.cosine[i] * x + h.sine[i] * z, yy, h.cosine[i] * z - h.sine[i] * x};
    wo = {-h.cosine[i] * x + h.sine[i] * z, -yy, h.cosine[i] * z + h.sine[i] * x};
    if (!reference.eval(wi, wo, f)) continue;
    ratio(wi, wo, f.data(), y.data());
    averages.add(cell, f.data(), y.data());
  }
  averages.finish();
  return b;
}

}  // namespace brdf::encode

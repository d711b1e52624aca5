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

/// Offsets of sub-positions from the middle of a cell, in cells.
std::vector<double> offsets(int count) {
  std::vector<double> o;
  for (int i = 0; i < count; ++i) o.push_back((i + 0.5) / count - 0.5);
  return o;
}

}  // namespace

Bins sample_bins(const Measurement& m, const LobeSet& lobes, const residual::Basis& basis, int n_h, int n_d, int n_p,
                 int substeps) {
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
  const MeasurementInterpolator reference(m);
  const std::vector<double> offset = offsets(substeps);
  std::vector<double> f(n), y(n);
  std::size_t cell = 0;
  for (int i = 0; i < n_h; ++i)
    for (int j = 0; j < n_d; ++j)
      for (int k = 0; k < n_p; ++k, ++cell) {
        const auto ih = static_cast<std::size_t>(i), jd = static_cast<std::size_t>(j), kp = static_cast<std::size_t>(k);
        const double base = h.cosine[ih] * d.cosine[jd], tilt = h.sine[ih] * d.sine[jd] * b.cos_phi[kp];
        b.cos_i[cell] = base - tilt;
        b.cos_o[cell] = base + tilt;
        if (std::min(b.cos_i[cell], b.cos_o[cell]) < lowest_cosine) continue;
        int seen = 0;
        for (const double oh : offset)
          for (const double od : offset)
            for (const double op : offset) {
              Vec3d wi, wo;
              geometry::directions_from_half_difference(theta_of((i + 0.5 + oh) / n_h, basis.kappa_h),
                                                        theta_of((j + 0.5 + od) / n_d, basis.kappa_d),
                                                        (k + 0.5 + op) / n_p * std::numbers::pi, wi, wo);
              if (std::min(wi.z, wo.z) < lowest_cosine || !reference.eval(wi, wo, f)) continue;
              ratio(wi, wo, f.data(), y.data());
              ++seen;
              for (std::size_t c = 0; c < n; ++c) {
                b.f[cell * n + c] += f[c];
                b.y[cell * n + c] += y[c];
              }
            }
        if (seen == 0) continue;
        b.valid[cell] = 1;
        for (std::size_t c = 0; c < n; ++c) {
          b.f[cell * n + c] /= seen;
          b.y[cell * n + c] /= seen;
        }
      }
  return b;
}

}  // namespace brdf::encode

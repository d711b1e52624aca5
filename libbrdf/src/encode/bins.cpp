// SPDX-License-Identifier: Apache-2.0
#include "encode/bins.h"

#include "encode/bin_positions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

struct Axis {
  std::vector<double> u, sine, cosine, width;
};

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
  std::vector<double> f(n), y(n);
  std::size_t cell = 0;
  for (int i = 0; i < n_h; ++i)
    for (int j = 0; j < n_d; ++j)
      for (int k = 0; k < n_p; ++k, ++cell) {
        const auto ih = static_cast<std::size_t>(i), jd = static_cast<std::size_t>(j), kp = static_cast<std::size_t>(k);
        const double base = h.cosine[ih] * d.cosine[jd], tilt = h.sine[ih] * d.sine[jd] * b.cos_phi[kp];
        b.cos_i[cell] = base - tilt;
        b.cos_o[cell] = base + tilt;
      }
  std::vector<int> seen(cells, 0);
  for_sub_positions(b, basis, substeps, [&](std::size_t at, const Vec3d& wi, const Vec3d& wo, double) {
    if (!reference.eval(wi, wo, f)) return;
    ratio(wi, wo, f.data(), y.data());
    ++seen[at];
    for (std::size_t c = 0; c < n; ++c) {
      b.f[at * n + c] += f[c];
      b.y[at * n + c] += y[c];
    }
  });
  for (std::size_t at = 0; at < cells; ++at) {
    if (seen[at] == 0) continue;
    b.valid[at] = 1;
    for (std::size_t c = 0; c < n; ++c) {
      b.f[at * n + c] /= seen[at];
      b.y[at * n + c] /= seen[at];
    }
  }
  return b;
}

}  // namespace brdf::encode

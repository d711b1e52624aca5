// SPDX-License-Identifier: Apache-2.0
#include "encode/dense_kernels.h"
#include "encode/error_model.h"
#include "residual/order_extent.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brdf::encode {
namespace {

constexpr double gamma = 2.2;

/// Products of basis functions at one pair of directions, added to a row.
class BasisRow {
 public:
  BasisRow(const residual::Basis& basis, residual::Azimuth azimuth, std::span<const residual::Frequency> order)
      : basis_(basis), azimuth_(azimuth), order_(order) {
    const residual::Extent e = residual::extent(order);
    k_.resize(static_cast<std::size_t>(e.k));
    l_.resize(static_cast<std::size_t>(e.l));
    m_.resize(static_cast<std::size_t>(e.m));
    lm_.resize(l_.size() * m_.size());
  }
  void add(const Vec3d& wi, const Vec3d& wo, double weight, double* row) {
    const geometry::HalfDifference<double> g = geometry::half_difference(wi, wo);
    const double u_h = residual::warp(residual::chord(g.sin_theta_h, g.cos_theta_h), basis_.kappa_h);
    const double u_d = residual::warp(residual::chord(g.sin_theta_d, g.cos_theta_d), basis_.kappa_d);
    residual::cosines(std::cos(3.14159265358979324 * u_h), static_cast<int>(k_.size()), k_.data());
    residual::cosines(std::cos(3.14159265358979324 * u_d), static_cast<int>(l_.size()), l_.data());
    const double cross = (wi.x + wo.x) * (wi.y - wo.y) - (wi.y + wo.y) * (wi.x - wo.x);  // has the sign of sin phi_d
    const bool turned = azimuth_ == residual::Azimuth::reciprocal && cross < 0;
    residual::harmonics(turned ? -g.cos_phi_d : g.cos_phi_d, azimuth_, static_cast<int>(m_.size()), m_.data());
    const double window = residual::pole_window(g.sin_theta_h, basis_.window_h) * residual::pole_window(g.sin_theta_d, basis_.window_d);
    double power = weight;
    for (std::size_t m = 0; m < m_.size(); ++m, power *= window)
      for (std::size_t l = 0; l < l_.size(); ++l)
        lm_[m * l_.size() + l] = m_[m] * power * l_[l] * (residual::harmonic(static_cast<int>(m), azimuth_).sine ? window : 1.0);
    for (std::size_t j = 0; j < order_.size(); ++j) row[j] += k_[order_[j].k] * lm_[order_[j].m * l_.size() + order_[j].l];
  }

 private:
  const residual::Basis& basis_;
  residual::Azimuth azimuth_;
  std::span<const residual::Frequency> order_;
  std::vector<double> k_, l_, m_, lm_;
};

}  // namespace

ImageSlopes image_slopes(const Measurement& m, const metrics::QuerySet& queries) {
  const metrics::ImageRows& image = queries.image[0];
  const int channels = m.channels.count;
  const auto n = static_cast<std::size_t>(channels);
  const MeasurementInterpolator reference(m);
  ImageSlopes out;
  out.f.resize(image.rows * n);
  std::vector<double> light(image.pixels * n, 0.0);
  for (std::size_t r = 0; r < image.rows; ++r) {
    const std::size_t row = image.first + r;
    reference.eval(Vec3d(queries.wi[row]), Vec3d(queries.wo[row]), std::span(out.f).subspan(r * n, n));
    for (std::size_t c = 0; c < n; ++c)
      light[queries.pixel[row] * n + c] += out.f[r * n + c] * queries.gain(row, static_cast<int>(c), channels);
  }
  double mean = 0;
  for (const double v : light) mean += v;
  mean /= static_cast<double>(light.size());
  if (!(mean > 0)) return out;
  const double exposure = 0.5 / mean;
  out.slope.resize(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double v = std::max(light[i], 1e-3 * mean);
    out.slope[i] = light[i] * exposure < 1 ? std::pow(v * exposure, 1 / gamma) / gamma / v : 0.0;
  }
  return out;
}

void add_rows(ErrorModel& model, std::span<const double> rows, std::span<const double> targets,
              const std::vector<double>& channel_matrix, double scale) {
  const std::size_t count = rows.size() / model.size, n = model.b.size();
  add_outer_products(model.gram.data(), model.size, rows.data(), count, scale);
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t p = 0; p < count; ++p) {
      double y = 0;
      for (std::size_t c = 0; c < n; ++c) y += channel_matrix[t * n + c] * targets[p * n + c];
      model.constant += scale * y * y;
      const double* a = rows.data() + p * model.size;
      add_scaled(model.b[t].data(), a, scale * y, model.size);
    }
}

void add_environment(ErrorModel& model, const ImageSlopes& shown, const LobeSet& lobes, const metrics::QuerySet& queries,
                     const residual::Basis& basis, residual::Azimuth azimuth, std::span<const residual::Frequency> order,
                     residual::ChannelTransform transform, double weight) {
  const metrics::ImageRows& image = queries.image[0];
  const int channels = lobes.channels;
  const auto n = static_cast<std::size_t>(channels);

  // rows of the operator: pixel values as linear functions of the coefficients (one for all channels) and their target
  std::vector<double> rows(image.pixels * model.size, 0.0), target(image.pixels * n, 0.0), l(n);
  BasisRow basis_row(basis, azimuth, order);
  for (std::size_t r = 0; r < image.rows; ++r) {
    const std::size_t row = image.first + r, pixel = queries.pixel[row];
    const Vec3d wi(queries.wi[row]), wo(queries.wo[row]);
    double g = 0;
    for (std::size_t c = 0; c < n; ++c)
      g += shown.slope[pixel * n + c] * (shown.f[r * n + c] + basis.epsilon) * queries.gain(row, static_cast<int>(c), channels);
    g /= static_cast<double>(n);
    if (g == 0) continue;
    eval_lobes(lobes, wi, wo, l);
    for (std::size_t c = 0; c < n; ++c)
      target[pixel * n + c] += g * std::log((shown.f[r * n + c] + basis.epsilon) / (l[c] + basis.epsilon));
    basis_row.add(wi, wo, g, rows.data() + pixel * model.size);
  }
  add_rows(model, rows, target, residual::channel_matrix(transform, channels), weight / image.pixels);
}

}  // namespace brdf::encode

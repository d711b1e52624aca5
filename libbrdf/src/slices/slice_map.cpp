// SPDX-License-Identifier: Apache-2.0
#include "slices/slice_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::slices {
namespace {

using std::numbers::pi;

double elevation_of(double u) noexcept { return u * u * (pi / 2); }

/// t in [0, 1] where the integral of the line from a to b reaches `wanted`.
double inside(double a, double b, double wanted) noexcept {
  if (!(wanted > 0)) return 0.0;
  const double slope = b - a, root = std::sqrt(std::max(a * a + 2 * slope * wanted, 0.0));
  return a + root > 0 ? std::min(2 * wanted / (a + root), 1.0) : 1.0;
}

}  // namespace

double ndf_of(int code, int step) noexcept { return std::exp2(code * std::exp2(-0.5 * step)); }

SliceAngles slice_angles(double ix, double iy, double iz, double ox, double oy, double oz) noexcept {
  const double hx = ix + ox, hy = iy + oy, hz = iz + oz;
  const double rho_i = std::sqrt(ix * ix + iy * iy), rho_h = std::sqrt(hx * hx + hy * hy);
  SliceAngles at;
  at.theta_i = std::atan2(rho_i, iz);
  at.u_h = std::sqrt(std::atan2(rho_h, hz) * (2 / pi));
  // a direction along the normal has azimuth 0; isotropy leaves the choice free
  const double along = ix * hx + iy * hy, across = ix * hy - iy * hx;
  const double phi = rho_i > 0 && rho_h > 0 ? std::atan2(std::fabs(across), along) : 0.0;
  at.v_h = (pi - phi) / (2 * pi);
  return at;
}

SliceMap::Cell SliceMap::cell(double x, std::size_t count) noexcept {
  const double limited = std::clamp(x, 0.0, static_cast<double>(count - 1));
  const auto left = std::min(static_cast<std::size_t>(limited), count - 2);
  return {left, static_cast<float>(limited - static_cast<double>(left))};
}

SliceMap::SliceMap(const residual::SliceFrame& frame)
    : columns_(frame.ndf.size()), rows_((frame.rows + 1U) / 2U), all_rows_(frame.rows) {
  for (const std::uint16_t code : frame.theta_i) theta_i_.push_back(code * (pi / 2 / 65535));
  for (const std::int16_t code : frame.ndf) ndf_.push_back(static_cast<float>(ndf_of(code, frame.ndf_step)));
  samples_.resize(theta_i_.size() * rows_ * columns_);
  row_.resize(theta_i_.size() * rows_);
  for (std::size_t s = 0; s < theta_i_.size(); ++s) build_slice(s);
  build_sigma();
}

void SliceMap::build_slice(std::size_t slice) {
  const double sin_i = std::sin(theta_i_[slice]), cos_i = std::cos(theta_i_[slice]);
  // max(0, wi . m) u sin theta dtheta: the density over (u, v), apart from constants
  std::vector<float> along(columns_), across(columns_);
  for (std::size_t x = 0; x < columns_; ++x) {
    const double u = static_cast<double>(x) / static_cast<double>(columns_ - 1), theta = elevation_of(u);
    const double common = static_cast<double>(ndf_[x]) * u * std::sin(theta);
    along[x] = static_cast<float>(common * cos_i * std::cos(theta));
    across[x] = static_cast<float>(common * sin_i * std::sin(theta));
  }
  Sample* sample = samples_.data() + slice * rows_ * columns_;
  Row* row = row_.data() + slice * rows_;
  double sum = 0, previous = 0;
  for (std::size_t r = 0; r < rows_; ++r) {
    const auto cos_phi = static_cast<float>(std::cos((2 * static_cast<double>(r) / static_cast<double>(all_rows_ - 1) - 1) * pi));
    float total = 0, last = 0;
    for (std::size_t x = 0; x < columns_; ++x) {
      const float density = std::max(along[x] + across[x] * cos_phi, 0.0f);
      if (x > 0) total += 0.5f * (last + density);
      sample[r * columns_ + x] = {density, total};
      last = density;
    }
    if (r > 0) sum += 0.5 * (previous + static_cast<double>(total));
    previous = static_cast<double>(total);
    row[r] = {total, static_cast<float>(sum)};
  }
  // the other half of the circle mirrors this one; with an even number of rows a cell lies between the halves
  double all = 2 * sum;
  if (all_rows_ % 2 == 0) all += previous;
  if (!(all > 0)) return;
  const auto scale = static_cast<float>(1 / all);
  for (std::size_t r = 0; r < rows_; ++r) {
    row[r].total *= scale;
    row[r].before *= scale;
  }
  for (std::size_t k = 0; k < rows_ * columns_; ++k) {
    sample[k].density *= scale;
    sample[k].before *= scale;
  }
}

/// sigma(wi) = integral of D(m) max(0, m . wi): over phi in closed form, over theta by the trapezoidal rule.
void SliceMap::build_sigma() {
  sigma_.resize(sigma_nodes);
  std::vector<double> weight(columns_), tangent(columns_), sine(columns_), cosine(columns_);
  for (std::size_t x = 0; x < columns_; ++x) {
    const double u = static_cast<double>(x) / static_cast<double>(columns_ - 1), theta = elevation_of(u);
    sine[x] = std::sin(theta);
    cosine[x] = std::cos(theta);
    weight[x] = static_cast<double>(ndf_[x]) * sine[x] * u / static_cast<double>(columns_ - 1) * (x + 1 == columns_ ? 0.5 : 1.0);
  }
  for (std::size_t k = 0; k < sigma_nodes; ++k) {
    const double theta_i = elevation_of(static_cast<double>(k) / (sigma_nodes - 1)), sin_i = std::sin(theta_i), cos_i = std::cos(theta_i);
    double sum = 0;
    for (std::size_t x = 0; x < columns_; ++x) {
      const double a = cos_i * cosine[x], b = sin_i * sine[x];
      double over_phi = 2 * pi * a;
      if (a < b) {
        const double edge = std::acos(-a / b);
        over_phi = 2 * (a * edge + std::sqrt(b * b - a * a));
      }
      sum += weight[x] * over_phi;
    }
    sigma_[k] = static_cast<float>(sum);
  }
  const float normal = sigma_[0] > 0 ? 1 / sigma_[0] : 1.0f;
  for (float& s : sigma_) s = std::max(s * normal, 1e-6f);
}

double SliceMap::jacobian(const SliceAngles& at) const noexcept {
  const Cell u = cell(at.u_h * static_cast<double>(columns_ - 1), columns_);
  const Cell s = cell(std::sqrt(at.theta_i * (2 / pi)) * static_cast<double>(sigma_nodes - 1), sigma_nodes);
  const float ndf = ndf_[u.left] + u.fraction * (ndf_[u.left + 1] - ndf_[u.left]);
  const float sigma = sigma_[s.left] + s.fraction * (sigma_[s.left + 1] - sigma_[s.left]);
  return static_cast<double>(ndf / (4 * sigma));
}

SlicePoint SliceMap::point(const SliceAngles& at, double cos_o) const noexcept {
  SlicePoint p;
  const auto above = static_cast<std::size_t>(std::upper_bound(theta_i_.begin(), theta_i_.end(), at.theta_i) - theta_i_.begin());
  p.slice = std::min(above > 0 ? above - 1 : 0, theta_i_.size() - 2);
  p.fraction = static_cast<float>(std::clamp((at.theta_i - theta_i_[p.slice]) / (theta_i_[p.slice + 1] - theta_i_[p.slice]), 0.0, 1.0));
  const Cell x = cell(at.u_h * static_cast<double>(columns_ - 1), columns_);
  // beyond the last folded row lies its mirror image
  const double y_full = at.v_h * static_cast<double>(all_rows_ - 1);
  const Cell y = cell(std::min(y_full, static_cast<double>(rows_ - 1)), rows_);
  const float beyond = static_cast<float>(std::max(y_full - static_cast<double>(rows_ - 1), 0.0));
  float left = 0, right = 0, along_row = 0, below = 0, upper = 0, before = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t s = p.slice + k;
    const float w = k == 0 ? 1 - p.fraction : p.fraction;
    const Sample* lower = samples(s, y.left) + x.left;
    const Sample* higher = lower + columns_;
    const Row* row = row_.data() + s * rows_ + y.left;
    left += w * (lower[0].density + y.fraction * (higher[0].density - lower[0].density));
    right += w * (lower[1].density + y.fraction * (higher[1].density - lower[1].density));
    along_row += w * (lower[0].before + y.fraction * (higher[0].before - lower[0].before));
    below += w * row[0].total;
    upper += w * row[1].total;
    before += w * row[0].before;
  }
  const float row_total = below + y.fraction * (upper - below);
  const float u = row_total > 0 ? (along_row + x.fraction * (left + 0.5f * x.fraction * (right - left))) / row_total : 0.0f;
  const float v = before + y.fraction * (below + 0.5f * y.fraction * (upper - below)) + beyond * upper;
  p.u = std::clamp(u, 0.0f, 1.0f);
  p.v = std::clamp(v, 0.0f, 0.5f);
  p.scale = static_cast<float>(jacobian(at) / std::max(cos_o, 1e-9));
  return p;
}

SliceMap::RowPosition SliceMap::row_at(std::size_t slice, double v) const noexcept {
  const Row* row = row_.data() + slice * rows_;
  RowPosition at{0, 0, 0};
  while (at.row + 2 < rows_ && static_cast<double>(row[at.row + 1].before) < v) ++at.row;
  at.fraction = inside(static_cast<double>(row[at.row].total), static_cast<double>(row[at.row + 1].total),
                       v - static_cast<double>(row[at.row].before));
  const double last_total = static_cast<double>(row[rows_ - 1].total);
  if (last_total > 0) at.beyond = std::clamp((v - static_cast<double>(row[rows_ - 1].before)) / last_total, 0.0, 0.5);
  return at;
}

double SliceMap::row_density(std::size_t slice, double v) const noexcept {
  const RowPosition p = row_at(slice, v);
  const Row* row = row_.data() + slice * rows_ + p.row;
  return static_cast<double>(row[0].total) + p.fraction * static_cast<double>(row[1].total - row[0].total);
}

SliceAngles SliceMap::angles(std::size_t slice, double u, double v) const noexcept {
  const RowPosition p = row_at(slice, v);
  const Sample *a = samples(slice, p.row), *b = samples(slice, p.row + 1);
  const auto blend = [&p](float x, float y) { return static_cast<double>(x) + p.fraction * static_cast<double>(y - x); };
  const double wanted = u * row_density(slice, v) * (1 - 1e-6);
  std::size_t x = 0;
  while (x + 2 < columns_ && blend(a[x + 1].before, b[x + 1].before) < wanted) ++x;
  const double t = inside(blend(a[x].density, b[x].density), blend(a[x + 1].density, b[x + 1].density), wanted - blend(a[x].before, b[x].before));
  SliceAngles at;
  at.theta_i = theta_i_[slice];
  at.u_h = (static_cast<double>(x) + t) / static_cast<double>(columns_ - 1);
  at.v_h = std::min((static_cast<double>(p.row) + p.fraction + p.beyond) / static_cast<double>(all_rows_ - 1), 0.5);
  return at;
}

}  // namespace brdf::slices

// SPDX-License-Identifier: Apache-2.0
#include <brdf/error.h>
#include <brdf/ggx_energy.h>

#include "lobes/ggx.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace brdf {

namespace {

/// Gauss and Legendre's rule for [0, 1].
template <std::size_t N>
struct GaussRule {
  std::array<double, N> x, weight;
  GaussRule() {
    for (std::size_t i = 0; i < N; ++i) {
      double t = std::cos(lobes::pi * (static_cast<double>(i) + 0.75) / (N + 0.5)), slope = 1;
      for (int step = 0; step < 8; ++step) {  // Newton, on the recurrence of the polynomials
        double before = 1, now = t;
        for (std::size_t k = 2; k <= N; ++k) {
          const auto n = static_cast<double>(k);
          const double next = ((2 * n - 1) * t * now - (n - 1) * before) / n;
          before = now;
          now = next;
        }
        slope = static_cast<double>(N) * (before - t * now) / (1 - t * t);
        t -= now / slope;
      }
      x[i] = 0.5 * (1 - t);
      weight[i] = 1 / ((1 - t * t) * slope * slope);
    }
  }
};

/// 1 - E: the mean, over the normals m that the view sees, of what is shadowed, 1 - G2 / G1 = Lambda_i / (1 + Lambda_o +
/// Lambda_i), and of 1 where the reflection goes below the horizon. The density of visible normals G1 D max(0, wo . m) / mu
/// (Heitz 2014 eq. 16) is, with tan theta_m = alpha tan v and mu (1 + Lambda_o) = (mu + S) / 2,
///   2 / (mu + S) (sin theta_o alpha sin^2 v cos phi + mu sin v cos v) / pi   per dv dphi.
/// Each azimuth is cut where the reflection meets the horizon, tan theta = (r + x) / mu with x = sin theta_o cos phi and
/// r^2 = mu^2 + x^2, and where the normal is seen no more; between these the integrand is smooth.
double loss_by_quadrature(double mu, double alpha) {
  static const GaussRule<24> rule;
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0)), half_turn = 0.5 * lobes::pi;
  const double density = 4 / (lobes::pi * (mu + lobes::ggx_slope_length(mu, alpha))), lambda_o = lobes::ggx_lambda(mu, alpha);
  const auto lost = [&](double v, double cos_phi) {
    const double tangent = alpha * std::tan(v), cos2 = 1 / (1 + tangent * tangent);
    const double cos_i = 2 * (sine * tangent * cos_phi + mu) * cos2 - mu;
    if (!(cos_i > 0)) return 1.0;  // on the horizon, up to rounding
    const double lambda_i = lobes::ggx_lambda(cos_i, alpha);
    return lambda_i / (1 + lambda_o + lambda_i);
  };
  double sum = 0;
  // nodes crowd, by squares, at right angles to the view, where all changes within mu of it, and at the horizon
  for (const double side : {1.0, -1.0})
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const double t = rule.x[i], cos_phi = side * std::sin(half_turn * t * t), x = sine * cos_phi, r = std::hypot(mu, x);
      const double horizon = std::atan((x >= 0 ? (r + x) / mu : mu / (r - x)) / alpha);
      const double seen = x >= 0 ? half_turn : std::atan(mu / (-x * alpha));
      for (std::size_t j = 0; j < rule.x.size(); ++j) {
        const auto at = [&](double v, double share) {
          const double s = std::sin(v);
          return rule.weight[j] * (sine * alpha * s * s * cos_phi + mu * s * std::cos(v)) * share;
        };
        const double rest = 1 - rule.x[j], above = horizon * (1 - rest * rest), below = horizon + (seen - horizon) * rule.x[j];
        sum += rule.weight[i] * t * lobes::pi * (2 * horizon * rest * at(above, lost(above, cos_phi)) + (seen - horizon) * at(below, 1));
      }
    }
  return density * sum;
}

/// Nodes over x = sqrt(log(1 + mu / alpha) / log(1 + 1 / alpha)): losses rise from the horizon within cosines of about
/// alpha and fall from there to 1 as a power.
double cosine_at(double x, double alpha, double range) noexcept { return alpha * std::expm1(x * x * range); }

}  // namespace

GgxEnergy::GgxEnergy(double alpha) : alpha_(alpha), range_(std::log1p(1 / alpha)) {
  if (!(alpha >= lobes::min_alpha && alpha <= lobes::max_alpha))
    throw Error(ErrorCode::invalid_argument, "GgxEnergy: alpha is " + std::to_string(alpha) + ", allowed is 1e-5 to 1.");
  const auto last = static_cast<double>(nodes - 1);
  // at the horizon nothing is lost: all visible normals reflect upwards, and Lambda_o is infinite
  for (std::size_t i = 1; i < nodes; ++i)
    loss_[i] = loss_by_quadrature(std::min(cosine_at(static_cast<double>(i) / last, alpha, range_), 1.0), alpha);
  // of the interpolated losses, so that the compensation returns exactly what they miss
  static const GaussRule<6> rule;
  for (std::size_t i = 0; i + 1 < nodes; ++i)
    for (std::size_t k = 0; k < rule.x.size(); ++k) {
      const double x = (static_cast<double>(i) + rule.x[k]) / last, mu = cosine_at(x, alpha, range_);
      const double slope = 2 * x * range_ * (alpha + mu);  // d mu / d x
      mean_loss_ += rule.weight[k] / last * slope * 2 * mu * (loss_[i] + rule.x[k] * (loss_[i + 1] - loss_[i]));
    }
}

double GgxEnergy::loss(double cos_theta) const noexcept {
  const double mu = std::min(std::max(0.0, cos_theta), 1.0);  // NaN gives 0
  const double x = std::sqrt(std::log1p(mu / alpha_) / range_) * static_cast<double>(nodes - 1);
  const auto i = std::min(static_cast<std::size_t>(x), nodes - 2);
  return loss_[i] + (x - static_cast<double>(i)) * (loss_[i + 1] - loss_[i]);
}

double GgxEnergy::compensation(double cos_i, double cos_o) const noexcept {
  if (!(cos_i > 0) || !(cos_o > 0)) return 0;
  return loss(cos_i) * loss(cos_o) / (lobes::pi * mean_loss_);
}

double GgxEnergy::compensation_color(double mean_fresnel) const noexcept {
  return mean_fresnel * mean_fresnel * (1 - mean_loss_) / (1 - mean_fresnel * mean_loss_);
}

}  // namespace brdf

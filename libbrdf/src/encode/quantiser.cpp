// SPDX-License-Identifier: Apache-2.0
#include "encode/quantiser.h"

#include "encode/dense_kernels.h"
#include "residual/layer_codec.h"
#include "residual/order_extent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace brdf::encode {
namespace {

using residual::CoefficientModel;

/// Takes the place of an encoder when only the model's state is wanted.
struct Listener {
  bool bit(residual::AdaptiveBit& model, bool b) noexcept {
    model.update(b);
    return b;
  }
  static std::uint32_t raw(int /*count*/, std::uint32_t value) noexcept { return value; }
};

/// Bits per value and context after a pass over all coefficients, and the context of each.
class RateEstimate {
 public:
  RateEstimate(const std::vector<residual::Frequency>& order, bool reciprocal, std::size_t channels)
      : order_(order), reciprocal_(reciprocal), reach_(residual::extent(order)),
        field_(static_cast<int>(channels), reach_.k, reach_.l, reach_.m),
        activity_(channels, std::vector<std::uint8_t>(order.size(), 0)) {}

  void update(const std::vector<std::vector<std::int32_t>>& q, const std::vector<std::uint32_t>& end) {
    field_.clear();
    CoefficientModel model;
    Listener listener;
    for (std::uint32_t j = 0; j < order_.size(); ++j)
      for (std::size_t c = 0; c < q.size(); ++c) {
        const int activity = residual::activity_class(field_.activity(static_cast<int>(c), order_[j], reciprocal_));
        activity_[c][j] = static_cast<std::uint8_t>(activity);
        if (j >= end[c]) continue;
        model.code(listener, c == 0, activity, residual::radius_class(j), q[c][j]);
        if (q[c][j] != 0) field_.set(static_cast<int>(c), order_[j], q[c][j]);
      }
    for (int first = 0; first < 2; ++first)
      for (int a = 0; a < residual::activity_classes; ++a)
        for (int r = 0; r < residual::radius_classes; ++r)
          for (std::int32_t v = 0; v <= CoefficientModel::escape; ++v)
            bits_[static_cast<std::size_t>(first)][static_cast<std::size_t>(a)][static_cast<std::size_t>(r)][static_cast<std::size_t>(v)] =
                model.cost(first == 1, a, r, v);
  }

  double bits(std::size_t channel, std::uint32_t j, std::int32_t value) const noexcept {
    const std::int32_t magnitude = std::abs(value);
    const auto& row = bits_[channel == 0 ? 1 : 0][activity_[channel][j]][static_cast<std::size_t>(residual::radius_class(j))];
    double b = row[static_cast<std::size_t>(std::min(magnitude, CoefficientModel::escape))];
    if (magnitude >= CoefficientModel::escape) b += 2 * std::log2(magnitude - CoefficientModel::escape + 1.0) + 1;
    return b;
  }

 private:
  const std::vector<residual::Frequency>& order_;
  bool reciprocal_;
  residual::Extent reach_;
  residual::MagnitudeField field_;
  std::vector<std::vector<std::uint8_t>> activity_;
  std::array<std::array<std::array<std::array<double, CoefficientModel::escape + 1>, residual::radius_classes>,
                        residual::activity_classes>, 2> bits_{};
};

std::uint32_t end_of(const std::vector<std::int32_t>& q) noexcept {
  std::size_t e = q.size();
  while (e > 0 && q[e - 1] == 0) --e;
  return static_cast<std::uint32_t>(e);
}

/// The matrix of an error model, or its diagonal where that is all there is.
class Curvature {
 public:
  explicit Curvature(const ErrorModel& model) : model_(model) {}
  double at(std::size_t j) const noexcept { return model_.gram.empty() ? model_.diagonal[j] : model_.gram[j * model_.size + j]; }
  /// slope += amount * column j
  void add(std::size_t j, double amount, std::vector<double>& slope) const noexcept {
    if (model_.gram.empty()) {
      slope[j] += amount * model_.diagonal[j];
      return;
    }
    add_scaled(slope.data(), model_.gram.data() + j * model_.size, amount, model_.size);
  }

 private:
  const ErrorModel& model_;
};

constexpr double lambda_per_step2 = 0.12;  // slope of rate against distortion at a step, measured on several materials
constexpr std::uint32_t look_beyond_end = 40;  // coefficients past the last one that may come alive again in a pass

}  // namespace

Quantised quantise(const ErrorModel& model, const std::vector<std::vector<double>>& start,
                   const std::vector<residual::Frequency>& order, bool reciprocal, const QuantiserSettings& settings) {
  const std::size_t n = model.size, channels = model.b.size();
  double mean_diagonal = 0;
  const Curvature gram(model);
  for (std::size_t i = 0; i < n; ++i) mean_diagonal += gram.at(i);
  mean_diagonal /= static_cast<double>(n);
  const double step = settings.step, lambda = lambda_per_step2 * settings.lambda_scale * step * step * mean_diagonal;

  Quantised out;
  out.end.resize(channels);
  std::vector<std::vector<double>> slope(channels);  // G a - b
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<std::int32_t> q(n);
    slope[c].assign(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      const double x = std::clamp(start[c][j] / step, -1e6, 1e6);
      q[j] = static_cast<std::int32_t>(x + (x > 0 ? 0.25 : -0.25));
      if (q[j] == 0) continue;
      gram.add(j, q[j] * step, slope[c]);
    }
    for (std::size_t i = 0; i < n; ++i) slope[c][i] -= model.b[c][i];
    out.end[c] = end_of(q);
    out.q.push_back(std::move(q));
  }

  RateEstimate rate(order, reciprocal, channels);
  for (int pass = 0; pass < settings.passes; ++pass) {
    rate.update(out.q, out.end);
    bool changed = false;
    for (std::uint32_t j = 0; j < n; ++j) {
      const double curvature = gram.at(j);
      if (!(curvature > 0)) continue;
      for (std::size_t c = 0; c < channels; ++c) {
        if (j >= out.end[c] + look_beyond_end) continue;
        const std::int32_t now = out.q[c][j];
        const double best_real = std::clamp(now - slope[c][j] / (curvature * step), -1e6, 1e6);
        const auto toward_zero = static_cast<std::int32_t>(best_real);
        const std::int32_t away = toward_zero + (best_real > 0 ? 1 : -1);
        std::int32_t best = 0;
        double best_cost = 0;
        bool first = true;
        for (const std::int32_t v : {0, toward_zero, away}) {
          const double e = (v - best_real) * step;
          const double cost = curvature * e * e + lambda * rate.bits(c, j, v);
          if (first || cost < best_cost) {
            best = v;
            best_cost = cost;
            first = false;
          }
        }
        if (best == now) continue;
        gram.add(j, (best - now) * step, slope[c]);
        out.q[c][j] = best;
        changed = true;
      }
    }
    for (std::size_t c = 0; c < channels; ++c) out.end[c] = end_of(out.q[c]);
    if (!changed) break;
  }

  out.error = model.constant;
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t j = 0; j < n; ++j) out.error += out.q[c][j] * step * (slope[c][j] - model.b[c][j]);
  return out;
}

}  // namespace brdf::encode

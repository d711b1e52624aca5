// SPDX-License-Identifier: Apache-2.0
#include "encode/query_weight.h"

#include "encode/bin_positions.h"
#include "fit/collect_samples.h"
#include "fit/fit_samples.h"
#include "profile/profile_cells.h"

#include <brdf/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

constexpr int places = 3;              // along each axis of a cell of the profile
constexpr double most_of_fit = 0.9;    // lobes carry what no residual corrects, so they stay closer to all of the measurement
constexpr double least_slope = 0.05, largest_slope = 20;  // of the samples of the fit
constexpr double darkest_place = 0.1;  // of the mean f of its cell, as in the metric
constexpr double darkest_cell = 1e-3;  // of the mean f that was asked for, as in the metric

/// Cell of an axis of `n` cells, even in u.
std::size_t along(double u, int n) noexcept { return static_cast<std::size_t>(std::clamp(static_cast<int>(u * n), 0, n - 1)); }

std::size_t bin_at(const Bins& b, const residual::Basis& basis, const Vec3d& wi, const Vec3d& wo) noexcept {
  const geometry::HalfDifference<double> g = geometry::half_difference(wi, wo);
  const std::size_t h = along(residual::warp(residual::chord(g.sin_theta_h, g.cos_theta_h), basis.kappa_h), b.n_h);
  const std::size_t d = along(residual::warp(residual::chord(g.sin_theta_d, g.cos_theta_d), basis.kappa_d), b.n_d);
  const std::size_t p = along(std::acos(g.cos_phi_d) / std::numbers::pi, b.n_p);
  return p + static_cast<std::size_t>(b.n_p) * (d + static_cast<std::size_t>(b.n_d) * h);
}

double sum_of(const std::vector<double>& v) noexcept {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum;
}

/// Fractional parts of multiples of an irrational number: any prefix is evenly spread.
double turn(double ratio, std::size_t i) noexcept { return std::fmod(0.5 + ratio * static_cast<double>(i), 1.0); }

}  // namespace

QueryWeight::QueryWeight(const Measurement& m, const MaterialProfile& asked, double share) : share_(share) {
  const MeasurementInterpolator reference(m);
  const auto n = static_cast<std::size_t>(m.channels.count);
  std::vector<double> f(n);
  double total = 0, mean = 0;
  for (std::size_t i = 0; i < asked.histogram.size(); ++i) {
    if (asked.histogram[i] == 0) continue;
    Cell c{i, static_cast<double>(asked.histogram[i]), 0};
    int seen = 0;
    profile::for_places(i, 2, profile::lowest_cosine, [&](const Vec3d& wi, const Vec3d& wo) {
      if (!reference.eval(wi, wo, f)) return;
      ++seen;
      for (const double v : f) c.scale += v / static_cast<double>(n);
    });
    if (seen == 0) continue;  // not measured: nothing to fit
    c.scale /= seen;
    total += c.share;
    mean += c.share * c.scale;
    cells_.push_back(c);
  }
  if (cells_.empty())
    throw Error(ErrorCode::no_data, "the profile asks nothing of this material: no reflection contributes where something was measured");
  for (Cell& c : cells_) {
    c.share /= total;
    c.scale = std::max({c.scale, darkest_cell * mean / total, 1e-30});
  }
}

void QueryWeight::blend(const Bins& bins, const residual::Basis& basis, std::vector<double>& weights) const {
  const auto n = static_cast<std::size_t>(bins.channels);
  std::vector<double> asked(weights.size(), 0.0);
  std::vector<std::size_t> hit;
  for (const Cell& c : cells_) {
    hit.clear();
    profile::for_places(c.index, places, lowest_cosine, [&](const Vec3d& wi, const Vec3d& wo) {
      const std::size_t cell = bin_at(bins, basis, wi, wo);
      if (bins.valid[cell] != 0) hit.push_back(cell);
    });
    for (const std::size_t cell : hit) {
      double slope = 0;  // square of d f = (f + epsilon) d y, over f and the scale of its cell
      for (std::size_t k = 0; k < n; ++k) {
        const double f = std::max(bins.f[cell * n + k], 0.0), s = (f + basis.epsilon) / c.scale;
        slope += s * s / std::max(f / c.scale, darkest_place);
      }
      asked[cell] += c.share / static_cast<double>(hit.size()) * slope / static_cast<double>(n);
    }
  }
  const double usual = sum_of(weights), wanted = sum_of(asked);
  if (!(wanted > 0)) return;
  const double scale = share_ * usual / wanted;
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = (1 - share_) * weights[i] + scale * asked[i];
}

fit::SampleSet QueryWeight::samples(const Measurement& m, int count) const {
  const fit::SampleSet usual = fit::collect_samples(m, std::max(count / 2, 1));
  const MeasurementInterpolator reference(m);
  const auto n = static_cast<std::size_t>(m.channels.count);
  std::vector<double> ends, f(n);
  double end = 0;
  for (const Cell& c : cells_) ends.push_back(end += c.share);

  fit::SampleSet asked;
  const auto wanted = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < 8 * wanted && asked.size() < wanted; ++i) {
    // the cell by its share, then a place in it: the sequence of Roberts 2018 in four dimensions
    const auto at = std::upper_bound(ends.begin(), ends.end(), turn(0.8566748838545029, i) * end);
    const Cell& c = cells_[std::min(static_cast<std::size_t>(at - ends.begin()), cells_.size() - 1)];
    Vec3d wi, wo;
    profile::directions_in_cell(c.index, turn(0.733891856627126, i), turn(0.6287067210378086, i), turn(0.53859725722361, i), wi, wo);
    if (std::min(wi.z, wo.z) < lowest_cosine || !reference.eval(wi, wo, f)) continue;
    if (!std::all_of(f.begin(), f.end(), [](double v) { return std::isfinite(v); })) continue;
    asked.wi.push_back(wi);
    asked.wo.push_back(wo);
    // the loss is of log f; each place counts by its contribution, which its f has a share in
    double mean = 0;
    for (const double v : f) mean += std::max(v, 0.0) / static_cast<double>(n);
    asked.weight.push_back(std::clamp(mean / c.scale, least_slope, largest_slope));
    for (const double v : f) asked.values.push_back(std::max(v, 0.0));
  }
  if (asked.size() == 0) return usual;

  fit::SampleSet all;
  all.channels = m.channels.count;
  const double asked_of_fit = std::min(share_, most_of_fit);
  const double usual_scale = (1 - asked_of_fit) / std::max(sum_of(usual.weight), 1e-300), asked_scale = asked_of_fit / sum_of(asked.weight);
  const auto take = [&](const fit::SampleSet& from, std::size_t i, double scale) {
    if (i >= from.size()) return;
    all.wi.push_back(from.wi[i]);
    all.wo.push_back(from.wo[i]);
    all.weight.push_back(from.weight[i] * scale);
    all.values.insert(all.values.end(), from.values.begin() + static_cast<std::ptrdiff_t>(i * n), from.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
  };
  for (std::size_t i = 0; i < std::max(usual.size(), asked.size()); ++i) {
    take(usual, i, usual_scale);
    take(asked, i, asked_scale);
  }
  return all;
}

std::vector<QueryWeight> query_weights(const Measurement& m, const MaterialProfile* asked, const EffortStep& effort) {
  constexpr int careful_from = 50;  // effort
  std::vector<QueryWeight> weights;
  if (asked == nullptr) return weights;
  weights.emplace_back(m, *asked, asked_share);
  if (effort.effort >= careful_from) weights.emplace_back(m, *asked, careful_share);
  return weights;
}

FitResult fit_asked(const Measurement& m, const FitOptions& options, const QueryWeight* weight, const Progress& progress) {
  if (weight == nullptr) return fit_lobes(m, options, progress);
  fit::require_valid(options);
  return fit::fit_samples(weight->samples(m, options.samples), options, progress);
}

}  // namespace brdf::encode

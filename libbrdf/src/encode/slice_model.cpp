// SPDX-License-Identifier: Apache-2.0
#include "encode/slice_model.h"

#include "encode/bin_positions.h"
#include "encode/slice_corners.h"
#include "residual/basis.h"
#include "residual/order_extent.h"
#include "slices/slice_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

constexpr double least_weight = 1e-4;  // of the mean: nodes that no picture shows still follow the measurement, loosely

/// The samples as cells of a grid without poles: what cell_model transforms.
Bins as_bins(const SliceSamples& s) {
  Bins b;
  b.n_h = static_cast<int>(s.width);
  b.n_d = static_cast<int>(s.half_height);
  b.n_p = static_cast<int>(s.slices);
  b.channels = static_cast<int>(s.channels);
  const auto middles = [](std::size_t n) {
    std::vector<double> u(n);
    for (std::size_t i = 0; i < n; ++i) u[i] = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    return u;
  };
  b.u_h = middles(s.width);
  b.u_d = middles(s.half_height);
  for (const double u : middles(s.slices)) b.cos_phi.push_back(std::cos(std::numbers::pi * u));
  b.sin_h.assign(s.width, 1.0);
  b.sin_d.assign(s.half_height, 1.0);
  b.cos_i.assign(s.nodes(), 1.0);
  b.y.resize(s.y.size());
  return b;
}

/// Index of a node in the bins, whose slices run fastest.
std::size_t bin_of(const SliceSamples& s, std::size_t node) noexcept {
  const std::size_t u = node % s.width, v = node / s.width % s.half_height, slice = node / s.width / s.half_height;
  return slice + s.slices * (v + s.half_height * u);
}

slices::SlicePoint point_of(const slices::SliceMap& map, const Vec3d& wi, const Vec3d& wo) noexcept {
  return map.point(slices::slice_angles(wi.x, wi.y, wi.z, wo.x, wo.y, wo.z), wo.z);
}

/// out[f] = sum over i of in[i] cos(pi f (i + 1/2) / n) along the middle axis of [outer][n][inner].
std::vector<double> transform_axis(const std::vector<double>& in, std::size_t outer, std::size_t n, std::size_t inner) {
  std::vector<double> cosine(n * n), out(in.size(), 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t f = 0; f < n; ++f)
      cosine[f * n + i] = std::cos(std::numbers::pi * static_cast<double>(f) * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  for (std::size_t a = 0; a < outer; ++a)
    for (std::size_t i = 0; i < n; ++i) {
      const double* from = in.data() + (a * n + i) * inner;
      if (std::all_of(from, from + inner, [](double v) { return v == 0; })) continue;
      for (std::size_t f = 0; f < n; ++f) {
        double* to = out.data() + (a * n + f) * inner;
        for (std::size_t k = 0; k < inner; ++k) to[k] += cosine[f * n + i] * from[k];
      }
    }
  return out;
}

/// Inner products of a field over the nodes with every basis function: [m][l][k].
std::vector<double> project(std::vector<double> field, const SliceSamples& s) {
  field = transform_axis(field, s.slices * s.half_height, s.width, 1);
  field = transform_axis(field, s.slices, s.half_height, s.width);
  return transform_axis(field, 1, s.slices, s.half_height * s.width);
}

std::size_t place(const SliceSamples& s, residual::Frequency f) noexcept { return (f.m * s.half_height + f.l) * s.width + f.k; }

}  // namespace

std::vector<double> slice_weights(const Bins& bins, std::span<const double> cell_weights, const residual::Basis& basis,
                                  const residual::SliceFrame& frame, const SliceSamples& samples) {
  const slices::SliceMap map(frame);
  const double added = residual::epsilon_of(frame.epsilon);
  const auto n = samples.channels;
  std::vector<double> weights(samples.nodes(), 0.0);
  for_sub_positions(bins, basis, 2, [&](std::size_t cell, const Vec3d& wi, const Vec3d& wo, double share) {
    if (bins.valid[cell] == 0) return;
    const slices::SlicePoint p = point_of(map, wi, wo);
    double f = 0;
    for (std::size_t c = 0; c < n; ++c) f += std::max(bins.f[cell * n + c], 0.0);
    f /= static_cast<double>(n);
    // the weight is for log(f + epsilon), the table holds the logarithm of f / scale + added
    const double slope = (f + added * static_cast<double>(p.scale)) / (f + basis.epsilon);
    for (const SliceCorner& corner : slice_corners(p, frame)) weights[corner.node] += share * cell_weights[cell] * slope * slope * corner.weight;
  });
  double mean = 0;
  for (const double w : weights) mean += w;
  mean /= static_cast<double>(weights.size());
  for (double& w : weights) w = std::max(w, least_weight * mean + 1e-300);
  return weights;
}

ErrorModel slice_model(const SliceSamples& s, std::span<const double> weights, std::span<const residual::Frequency> order,
                       residual::ChannelTransform transform) {
  Bins bins = as_bins(s);
  std::vector<double> w(s.nodes());
  for (std::size_t node = 0; node < s.nodes(); ++node) {
    const std::size_t bin = bin_of(s, node);
    w[bin] = weights[node];
    for (std::size_t c = 0; c < s.channels; ++c) bins.y[bin * s.channels + c] = s.y[node * s.channels + c];
  }
  residual::Basis no_windows;
  no_windows.window_h = no_windows.window_d = 0;
  return cell_model(bins, w, no_windows, residual::Azimuth::one_way, order, transform);
}

ErrorModel slice_diagonal(const SliceSamples& s, std::span<const double> weights, std::span<const residual::Frequency> order,
                          const std::vector<std::vector<double>>& coefficients) {
  double total = 0;
  for (const double w : weights) total += w;
  ErrorModel model;
  model.size = order.size();
  for (const residual::Frequency f : order)
    model.diagonal.push_back(total / ((f.k > 0 ? 2 : 1) * (f.l > 0 ? 2 : 1) * (f.m > 0 ? 2 : 1)));
  for (std::size_t t = 0; t < s.channels; ++t) {
    std::vector<double> b(order.size());
    for (std::size_t j = 0; j < b.size(); ++j) {
      b[j] = model.diagonal[j] * coefficients[t][j];
      model.constant += b[j] * coefficients[t][j];
    }
    model.b.push_back(std::move(b));
  }
  return model;
}

void add_environment(ErrorModel& model, const ImageSlopes& image, const SliceSamples& s, const residual::SliceFrame& frame,
                     const metrics::QuerySet& queries, std::span<const residual::Frequency> order,
                     residual::ChannelTransform transform, double weight) {
  const slices::SliceMap map(frame);
  const metrics::ImageRows& rows = queries.image[0];
  const std::size_t n = s.channels;
  const double added = residual::epsilon_of(frame.epsilon);

  std::vector<std::vector<double>> pixel_rows(rows.pixels);
  for (std::size_t r = 0; r < rows.rows; ++r) {
    const std::size_t row = rows.first + r, pixel = queries.pixel[row];
    std::vector<double>& nodes = pixel_rows[pixel];
    if (nodes.empty()) nodes.assign(s.nodes(), 0.0);
    const slices::SlicePoint p = point_of(map, Vec3d(queries.wi[row]), Vec3d(queries.wo[row]));
    for (const SliceCorner& corner : slice_corners(p, frame)) {
      double g = 0;
      for (std::size_t c = 0; c < n; ++c)
        g += image.slope[pixel * n + c] * queries.gain(row, static_cast<int>(c), static_cast<int>(n)) * (s.value[corner.node * n + c] + added);
      nodes[corner.node] += g / static_cast<double>(n) * static_cast<double>(p.scale) * corner.weight;
    }
  }
  std::vector<double> a, targets;
  for (const std::vector<double>& nodes : pixel_rows) {
    if (nodes.empty()) continue;
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      for (std::size_t node = 0; node < nodes.size(); ++node) sum += nodes[node] * s.y[node * n + c];
      targets.push_back(sum);
    }
    const std::vector<double> projected = project(nodes, s);
    for (const residual::Frequency f : order) a.push_back(projected[place(s, f)]);
  }
  add_rows(model, a, targets, residual::channel_matrix(transform, static_cast<int>(n)), weight / rows.pixels);
}

std::vector<std::vector<double>> slice_coefficients(const SliceSamples& s, std::span<const residual::Frequency> order,
                                                    residual::ChannelTransform transform) {
  const std::vector<double> matrix = residual::channel_matrix(transform, static_cast<int>(s.channels));
  std::vector<std::vector<double>> out;
  for (std::size_t t = 0; t < s.channels; ++t) {
    std::vector<double> field(s.nodes(), 0.0);
    for (std::size_t node = 0; node < s.nodes(); ++node)
      for (std::size_t c = 0; c < s.channels; ++c) field[node] += matrix[t * s.channels + c] * s.y[node * s.channels + c];
    const std::vector<double> projected = project(std::move(field), s);
    std::vector<double> a;
    for (const residual::Frequency f : order)
      a.push_back(projected[place(s, f)] * (f.k > 0 ? 2 : 1) * (f.l > 0 ? 2 : 1) * (f.m > 0 ? 2 : 1) / static_cast<double>(s.nodes()));
    out.push_back(std::move(a));
  }
  return out;
}

}  // namespace brdf::encode

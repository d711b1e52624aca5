// SPDX-License-Identifier: Apache-2.0
#include "encode/distortion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace brdf::encode {
namespace {

constexpr double gamma = 2.2;
constexpr double widest_light = 75 * std::numbers::pi / 180;  // theta_d: half the angle between light and viewer
constexpr double beyond_widest = 0.15;
constexpr double grazing_cosine = 0.0872;  // 85 degrees

/// Share of a cell in the light that its view reflects, over views weighted by projected area; sums to about 1.
std::vector<double> energy_shares(const Bins& b) {
  constexpr std::size_t views = 24;
  const auto n = static_cast<std::size_t>(b.channels);
  const auto np = static_cast<std::size_t>(b.n_p), nd = static_cast<std::size_t>(b.n_d);
  std::vector<double> share(b.cells(), 0.0), reflected(views, 0.0), seen(views, 0.0);
  const auto view = [](double cosine) { return std::min(static_cast<std::size_t>(cosine * views), views - 1); };
  for (std::size_t cell = 0; cell < share.size(); ++cell) {
    if (b.valid[cell] == 0) continue;
    const std::size_t j = cell / np % nd, i = cell / np / nd;
    double mean = 0;
    for (std::size_t c = 0; c < n; ++c) mean += std::max(b.f[cell * n + c], 0.0);
    const double pairs = b.sin_h[i] * b.d_theta_h[i] * b.sin_d[j] * b.cos_d[j] * b.d_theta_d[j] * b.cos_o[cell];
    share[cell] = mean * b.cos_i[cell] * pairs;
    reflected[view(b.cos_o[cell])] += share[cell];
    seen[view(b.cos_o[cell])] += pairs;
  }
  double all = 0;
  for (const double s : seen) all += s;
  for (std::size_t cell = 0; cell < share.size(); ++cell) {
    if (share[cell] == 0) continue;
    const std::size_t v = view(b.cos_o[cell]);
    share[cell] *= seen[v] / (reflected[v] * all);
  }
  return share;
}

}  // namespace

std::vector<double> cell_weights(const Bins& b, double epsilon, const MetricMix& mix) {
  const auto n = static_cast<std::size_t>(b.channels);
  const auto np = static_cast<std::size_t>(b.n_p), nd = static_cast<std::size_t>(b.n_d), nh = static_cast<std::size_t>(b.n_h);
  std::vector<double> lights(b.cells(), 0.0), logs(b.cells(), 0.0);

  // a light at one angle to the viewer sees one theta_d: exposure and area belong to that slice
  std::vector<double> area_of(nd, 0.0), light_of(nd, 0.0);
  const auto for_cells = [&](auto&& body) {
    for (std::size_t i = 0; i < nh; ++i)
      for (std::size_t j = 0; j < nd; ++j)
        for (std::size_t k = 0; k < np; ++k) {
          const std::size_t cell = (i * nd + j) * np + k;
          if (b.valid[cell] != 0) body(cell, i, j);
        }
  };
  const auto area = [&](std::size_t cell, std::size_t i) { return b.cos_o[cell] * b.sin_h[i] * b.d_theta_h[i]; };
  for_cells([&](std::size_t cell, std::size_t i, std::size_t j) {
    double mean = 0;
    for (std::size_t c = 0; c < n; ++c) mean += b.f[cell * n + c];
    area_of[j] += area(cell, i);
    light_of[j] += area(cell, i) * mean / static_cast<double>(n) * b.cos_i[cell];
  });
  double lights_total = 0, logs_total = 0;
  for_cells([&](std::size_t cell, std::size_t i, std::size_t j) {
    const double exposure = 0.5 * area_of[j] / std::max(light_of[j], 1e-300);
    double shown = 0, logarithm = 0;
    for (std::size_t c = 0; c < n; ++c) {
      const double f = std::max(b.f[cell * n + c], 1e-3 * epsilon), x = f * b.cos_i[cell];
      const double to_log = (f + epsilon) / f;  // d log f per d y
      const double s = x * exposure < 1 ? std::pow(x * exposure, 1 / gamma) / gamma * to_log : 0.0;
      shown += s * s;
      logarithm += x / (1 + x) * to_log;
    }
    const double theta_d = std::atan2(b.sin_d[j], b.cos_d[j]);
    const double share = b.d_theta_d[j] * (theta_d < widest_light ? 1.0 : beyond_widest);
    lights[cell] = shown / static_cast<double>(n) * area(cell, i) / area_of[j] * share;
    lights_total += lights[cell];
    if (std::min(b.cos_i[cell], b.cos_o[cell]) > grazing_cosine)
      logs[cell] = logarithm / static_cast<double>(n) * b.sin_h[i] * b.d_theta_h[i] * b.sin_d[j] * b.cos_d[j] * b.d_theta_d[j];
    logs_total += logs[cell];
  });
  const double scale = 1 / widest_light;
  const double log_scale = logs_total > 0 ? mix.log * std::max(lights_total, 1e-300) / logs_total * scale : 0.0;
  std::vector<double> w(b.cells());
  const std::vector<double> energy = energy_shares(b);
  constexpr double half_grey = 0.11;  // (d shown / d log light)^2 = (0.5^(1/gamma) / gamma)^2
  for (std::size_t i = 0; i < w.size(); ++i)
    w[i] = mix.lights * lights[i] * scale + log_scale * logs[i] + mix.energy * half_grey * energy[i];
  // where nothing was measured the residual is asked, gently, to vanish: the lobes extrapolate better than cosines
  double sum = 0, measured = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    sum += w[i];
    measured += b.valid[i] != 0 ? 1 : 0;
  }
  const double gentle = measured > 0 ? 1e-5 * sum / measured : 1.0;
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = std::max(w[i], gentle);
  return w;
}

}  // namespace brdf::encode

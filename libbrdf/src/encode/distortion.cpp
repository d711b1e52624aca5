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
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = mix.lights * lights[i] * scale + log_scale * logs[i];
  return w;
}

}  // namespace brdf::encode

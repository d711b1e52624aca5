// SPDX-License-Identifier: Apache-2.0
#include "sample/integrand.h"

#include "eval/batch_eval.h"

#include <algorithm>
#include <cmath>

namespace brdf::sample {

void Integrand::add(const Part& part, const HalfVectorMap<double>& map, std::span<const Vec3d> wi, double side, std::span<double> f_cos) {
  const std::size_t size = wi.size(), channels = static_cast<std::size_t>(part.tables->lobes.channels);
  for (auto& plane : planes_) plane.resize(size);
  f_.resize(channels * size);
  auto& [wi_x, wi_y, wi_z, wo_x, wo_y, wo_z] = planes_;
  for (std::size_t i = 0; i < size; ++i) {
    wi_x[i] = static_cast<float>(wi[i].x);
    wi_y[i] = static_cast<float>(side * wi[i].y);
    wi_z[i] = static_cast<float>(wi[i].z);
  }
  std::fill(wo_x.begin(), wo_x.end(), static_cast<float>(part.turned ? -map.s : map.s));
  std::fill(wo_y.begin(), wo_y.end(), 0.0F);
  std::fill(wo_z.begin(), wo_z.end(), static_cast<float>(map.c));
  eval::eval_batch(*part.tables, {wi_x.data(), wi_y.data(), wi_z.data(), size}, {wo_x.data(), wo_y.data(), wo_z.data(), size},
                   {f_.data(), size});
  const double scale = part.sign / static_cast<double>(channels) * (both_sides_ ? 0.5 : 1.0);
  for (std::size_t i = 0; i < size; ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < channels; ++c) sum += static_cast<double>(f_[c * size + i]);
    f_cos[i] += scale * sum * std::max(static_cast<double>(wi_z[i]), 0.0);
  }
}

void Integrand::evaluate(const HalfVectorMap<double>& map, std::span<const Vec3d> wi, std::span<double> f_cos) {
  std::fill(f_cos.begin(), f_cos.end(), 0.0);
  for (const Part& part : parts_) {
    add(part, map, wi, 1, f_cos);
    if (both_sides_) add(part, map, wi, -1, f_cos);
  }
  for (double& f : f_cos) f = f > 0 && std::isfinite(f) ? f : 0;
}

}  // namespace brdf::sample

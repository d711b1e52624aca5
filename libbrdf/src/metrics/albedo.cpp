// SPDX-License-Identifier: Apache-2.0
#include "metrics/albedo.h"

#include "metrics/half_vector_density.h"
#include "metrics/low_discrepancy.h"

namespace brdf::metrics {
namespace {

constexpr double points_per_strategy = 2048;

}  // namespace

void append_albedo(QuerySet& set, double quality) {
  // The error that matters is that of a difference at equal points, so few points are enough at a low quality.
  const auto points = static_cast<std::uint32_t>(std::lround(std::max(points_per_strategy * std::sqrt(quality), 64.0)));
  const Sobol cosine(11), halves(13);
  for (std::size_t k = 0; k < albedo_cosines.size(); ++k) {
    set.albedo_begin[k] = set.wi.size();
    const double c = albedo_cosines[k];
    const Vec3f wo = rounded({std::sqrt(1 - c * c), 0, c});
    const auto add = [&](const Vec3d& direction) {
      const Vec3f wi = rounded(direction);
      if (!(wi.z > 0)) return;
      const double cos_i = static_cast<double>(wi.z);
      const double density = cos_i / std::numbers::pi + reflected_density(Vec3d(wi), Vec3d(wo));
      set.wi.push_back(wi);
      set.wo.push_back(wo);
      set.albedo_weight.push_back(cos_i / (density * points));
    };
    for (std::uint32_t p = 0; p < points; ++p) {
      const auto a = cosine(p), b = halves(p);
      const double r = std::sqrt(a[0]), phi = 2 * std::numbers::pi * a[1];
      add({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - a[0])});
      add(reflect_about(Vec3d(wo), half_vector(b[0], b[1])));
    }
  }
  set.albedo_begin.back() = set.wi.size();
}

void Albedos::add(const QuerySet& set, std::size_t first, std::size_t count, std::span<const float> f) noexcept {
  const auto n = static_cast<std::size_t>(channels);
  std::size_t angle = 0;
  while (first >= set.albedo_begin[angle + 1]) ++angle;
  double* sum = &value[angle * n];
  const double* weight = &set.albedo_weight[first - set.albedo_begin[0]];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < n; ++c) sum[c] += weight[i] * static_cast<double>(f[i * n + c]);
}

double Albedos::largest_difference(const Albedos& other) const noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < value.size(); ++i) largest = std::max(largest, std::abs(value[i] - other.value[i]));
  return largest;
}

}  // namespace brdf::metrics
